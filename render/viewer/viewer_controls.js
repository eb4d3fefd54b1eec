// The controls of the 3-D replay: buttons, time line, keys, links and labels.
// Opens the viewer of the page, in the element "viewer" with the data of "viewer-data". Without
// WebGL the element stays hidden, and the page shows an image.
(function () {
  'use strict';

  var SPEEDS = [0.25, 0.5, 1, 2, 4];
  var MOST_BUTTONS = 40;
  // The level of detail falls after three frames that are slower than this. The least one draws fewer pixels per CSS pixel.
  var SLOW_MS = 45, SLOW_FRAMES = 3, LEAST_DETAIL = 2, FEWER_PIXELS = 0.5;
  var SWITCHES = [['forces', 'Forces', true], ['cones', 'Friction cones', true], ['axes', 'Axes', true],
                  ['names', 'Names', true], ['xray', 'X-ray', false], ['ghost', 'Start pose', false],
                  ['path', 'Path', false], ['palm', 'Palm axes', false]];

  // Returns an element with a class and text.
  function make(tag, style, parent, text) {
    var element = document.createElement(tag);
    if (style) element.className = style;
    if (text !== undefined) element.textContent = text;
    if (parent) parent.appendChild(element);
    return element;
  }

  var ICONS = {
    previous: 'M6 5h3v14H6zM20 5v14L9 12z', play: 'M7 4l13 8-13 8z', pause: 'M6 4h4v16H6zM14 4h4v16h-4z',
    next: 'M15 5h3v14h-3zM4 5l11 7-11 7z', home: 'M12 3L2 12h3v8h5v-6h4v6h5v-8h3z',
    full: 'M3 3h7v3H6v4H3zM14 3h7v7h-3V6h-4zM3 14h3v4h4v3H3zM18 14h3v7h-7v-3h4z'
  };

  function button(style, parent, text, name, act) {
    var element = make('button', style, parent, text);
    element.type = 'button';
    if (name) {
      element.title = name;
      element.setAttribute('aria-label', name);
    }
    element.addEventListener('click', act);
    return element;
  }

  // Sets the icon of a button: a path in a square of side 24.
  function setIcon(element, path) {
    var space = 'http://www.w3.org/2000/svg';
    var svg = document.createElementNS(space, 'svg'), shape = document.createElementNS(space, 'path');
    svg.setAttribute('viewBox', '0 0 24 24');
    shape.setAttribute('d', path);
    svg.appendChild(shape);
    element.textContent = '';
    element.appendChild(svg);
  }

  function iconButton(parent, path, name, act) {
    var element = button('icon', parent, '', name, act);
    setIcon(element, path);
    return element;
  }

  function degrees(radians) {
    var text = (radians * 180 / Math.PI).toFixed(1);
    return (Number(text) === 0 ? '0.0' : text.replace('-', '\u2212')) + '\u00b0';
  }

  function forceText(newtons) {
    if (newtons === 0) return '0 N';
    if (newtons < 0.001 || newtons >= 10000) return newtons.toExponential(1) + ' N';
    return Number(newtons.toPrecision(3)) + ' N';
  }

  function hasWebGl() {
    try {
      var canvas = document.createElement('canvas');
      return !!(window.WebGLRenderingContext && canvas.getContext('webgl'));
    } catch (error) {
      return false;
    }
  }

  function Viewer(element, data) {
    this.element = element;
    this.data = data;
    this.scene = new RegraspScene(data);
    this.end = this.scene.replay.end;
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    this.slow = 0;   // number of successive slow frames
    this.level = 0;  // of detail, setLevel
    this.runs = 0;  // number of times that the replay was started
    this.options = {};
    this.steps = data.steps;
    this.build();
    this.renderer = new THREE.WebGLRenderer({canvas: this.canvas, antialias: true, alpha: true});
    this.pixelRatio = Math.min(2, window.devicePixelRatio || 1);
    this.renderer.setPixelRatio(this.pixelRatio);
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.01 * this.scene.reach, 100 * this.scene.reach);
    this.camera.up.set(0, 0, 1);
    if (data.planar) this.camera.up.set(0, 1, 0);
    this.orbit = new THREE.OrbitControls(this.camera, this.canvas);
    this.orbit.enableKeys = false;
    this.orbit.enableZoom = false;  // until the first click, so that the page scrolls
    this.orbit.screenSpacePanning = true;
    this.listen();
    element.classList.add('running');
    document.documentElement.classList.add('has-viewer');
    this.resize();
    this.home();
    this.followLink(true);
  }

  Viewer.prototype.build = function () {
    var viewer = this, data = this.data;
    this.stage = make('div', 'stage', this.element);
    this.canvas = make('canvas', '', this.stage);
    this.canvas.setAttribute('aria-label', 'Interactive 3-D replay');
    this.overlay = make('div', 'overlay', this.stage);
    this.status = make('div', 'status', this.stage);
    this.stepLine = make('strong', '', this.status);
    this.timeLine = make('span', '', this.status);
    this.banner = make('p', 'banner', this.stage, data.failure ? data.failure.heading : '');
    this.labels = this.scene.labels.map(function (label) {
      var element = make('span', 'tag ' + label.kind, viewer.overlay, label.text);
      element.style.borderColor = label.color;
      return element;
    });
    var bar = make('div', 'bar', this.element);
    iconButton(bar, ICONS.previous, 'Previous step (\u2190)', function () { viewer.jump(-1); });
    this.playButton = iconButton(bar, ICONS.play, 'Play or pause (space)', function () { viewer.toggle(); });
    iconButton(bar, ICONS.next, 'Next step (\u2192)', function () { viewer.jump(1); });
    var line = make('div', 'time', bar);
    this.slider = make('input', '', line);
    this.slider.type = 'range';
    this.slider.min = 0;
    this.slider.max = this.end;
    this.slider.step = 'any';
    this.slider.setAttribute('aria-label', 'Time');
    var ticks = make('div', 'ticks', line);
    this.steps.forEach(function (step) {
      var tick = make('i', step.verdict, ticks);
      tick.style.left = 100 * step.start / (viewer.end || 1) + '%';
    });
    this.speedButton = button('speed', bar, '1\u00d7', 'Speed', function () { viewer.changeSpeed(); });
    iconButton(bar, ICONS.home, 'Reset the view', function () { viewer.home(); });
    if (this.element.requestFullscreen) {
      iconButton(bar, ICONS.full, 'Full screen (f)', function () { viewer.fullScreen(); });
    }
    this.buildSteps();
    this.buildSwitches();
    this.table = make('table', 'fingers', this.element);
    var head = make('tr', '', make('thead', '', this.table));
    ['Finger', 'Force', 'Friction margin'].forEach(function (name) { make('th', '', head, name); });
    var body = make('tbody', '', this.table);
    this.rows = data.fingers.map(function (finger) {
      var row = make('tr', '', body), name = make('td', '', row);
      make('i', 'dot', name).style.background = finger.color;
      make('span', '', name, finger.name);
      return {row: row, force: make('td', '', row), margin: make('td', '', row)};
    });
  };

  Viewer.prototype.buildSteps = function () {
    var viewer = this;
    this.stepButtons = [];
    if (this.steps.length > MOST_BUTTONS) return;
    var list = make('div', 'steps', this.element);
    this.steps.forEach(function (step, index) {
      viewer.stepButtons.push(button(step.verdict, list, String(step.number), step.title, function () {
        viewer.openStep(index);
      }));
    });
  };

  Viewer.prototype.buildSwitches = function () {
    var viewer = this, list = make('div', 'switches', this.element);
    SWITCHES.forEach(function (each) {
      if (each[0] === 'palm' && !viewer.data.hand) return;
      var label = make('label', '', list), box = make('input', '', label);
      box.type = 'checkbox';
      box.checked = viewer.options[each[0]] = each[2];
      box.addEventListener('change', function () {
        viewer.options[each[0]] = box.checked;
        viewer.draw();
      });
      make('span', '', label, each[1]);
    });
  };

  Viewer.prototype.listen = function () {
    var viewer = this;
    this.slider.addEventListener('input', function () {
      viewer.pause();
      viewer.setTime(Number(viewer.slider.value));
    });
    this.orbit.addEventListener('change', function () { viewer.draw(); });
    this.canvas.addEventListener('mousedown', function () { viewer.orbit.enableZoom = true; });
    this.canvas.addEventListener('touchstart', function () { viewer.orbit.enableZoom = true; });
    this.element.addEventListener('mouseleave', function () { viewer.orbit.enableZoom = false; });
    window.addEventListener('resize', function () { viewer.resize(); });
    document.addEventListener('fullscreenchange', function () { viewer.resize(); });
    window.addEventListener('hashchange', function () { viewer.followLink(false); });
    document.addEventListener('keydown', function (event) { viewer.onKey(event); });
    if (window.matchMedia) {
      var dark = window.matchMedia('(prefers-color-scheme: dark)');
      if (dark.addEventListener) dark.addEventListener('change', function () { viewer.draw(); });
    }
  };

  Viewer.prototype.onKey = function (event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    var on = event.target, inside = this.element.contains(on);
    if (!inside && on !== document.body && on !== document.documentElement) return;
    var key = event.key;
    if (key === ' ' && on.tagName !== 'BUTTON' && on.type !== 'checkbox') this.toggle();
    else if (key === 'ArrowLeft') this.jump(-1);
    else if (key === 'ArrowRight') this.jump(1);
    else if (key >= '1' && key <= '9') this.openNumber(Number(key));
    else if (key === 'f') this.fullScreen();
    else return;
    event.preventDefault();
  };

  // ---- Time.

  Viewer.prototype.setTime = function (time) {
    this.time = Math.min(this.end, Math.max(0, time));
    this.draw();
  };

  // Returns the index of the step at the present time.
  Viewer.prototype.stepNow = function () {
    var index = 0;
    for (var i = 0; i < this.steps.length; ++i) {
      if (this.steps[i].start <= this.time + 1e-6) index = i;
    }
    return index;
  };

  Viewer.prototype.openStep = function (index) {
    this.pause();
    this.setTime(this.steps[index].start);
    try {
      history.replaceState(null, '', '#step=' + this.steps[index].number);
    } catch (error) {
      // A page inside another one has no address.
    }
  };

  Viewer.prototype.openNumber = function (number) {
    for (var i = 0; i < this.steps.length; ++i) {
      if (this.steps[i].number === number) this.openStep(i);
    }
  };

  // Goes to the next or the previous start of a step, or to the end.
  Viewer.prototype.jump = function (by) {
    var index = this.stepNow();
    var inside = this.time > this.steps[index].start + 1e-6;
    if (by < 0 && !inside) --index;
    if (by > 0) ++index;
    if (index >= this.steps.length) {
      this.pause();
      this.setTime(this.end);
    } else {
      this.openStep(Math.max(0, index));
    }
  };

  // Opens "#step=6" or "#t=2.5". A failed plan opens at the failing instant.
  Viewer.prototype.followLink = function (first) {
    var match = /^#(step|t)=([0-9]+(?:\.[0-9]+)?)$/.exec(location.hash);
    if (match && match[1] === 't') {
      this.pause();
      this.setTime(Number(match[2]));
    } else if (match) {
      this.openNumber(Number(match[2]));
    }
    if (first && !match) this.setTime(this.data.failure ? this.end : this.steps[0].end - 0.01);
    else if (first) this.draw();
  };

  Viewer.prototype.toggle = function () {
    if (this.playing) {
      this.pause();
      return;
    }
    if (this.time >= this.end - 1e-6) this.time = 0;
    this.playing = true;
    setIcon(this.playButton, ICONS.pause);
    var viewer = this, last = null, run = ++this.runs;
    requestAnimationFrame(function advance(now) {
      if (!viewer.playing || run !== viewer.runs) return;
      var seconds = last === null ? 0 : Math.min(0.1, (now - last) / 1000);
      if (last !== null) viewer.adapt(now - last);
      last = now;
      viewer.setTime(viewer.time + viewer.speed * seconds);
      if (viewer.time >= viewer.end) viewer.pause();
      requestAnimationFrame(advance);
    });
  };

  Viewer.prototype.pause = function () {
    this.playing = false;
    setIcon(this.playButton, ICONS.play);
    if (this.level > 0) this.setLevel(0);
  };

  // Reduces the level of detail after a few slow frames.
  Viewer.prototype.adapt = function (interval_ms) {
    this.slow = interval_ms > SLOW_MS ? this.slow + 1 : 0;
    if (this.slow < SLOW_FRAMES || this.level === LEAST_DETAIL) return;
    this.slow = 0;
    this.setLevel(this.level + 1);
  };

  // Sets the level of detail: 0 is the full one, 1 has coarse meshes, 2 also fewer pixels.
  Viewer.prototype.setLevel = function (level) {
    this.level = level;
    this.scene.setCoarse(level > 0);
    this.renderer.setPixelRatio(level === LEAST_DETAIL ? FEWER_PIXELS : this.pixelRatio);
    this.resize();
  };

  Viewer.prototype.changeSpeed = function () {
    this.speed = SPEEDS[(SPEEDS.indexOf(this.speed) + 1) % SPEEDS.length];
    this.speedButton.textContent = this.speed + '\u00d7';
  };

  // ---- View.

  Viewer.prototype.fullScreen = function () {
    if (document.fullscreenElement) document.exitFullscreen();
    else if (this.element.requestFullscreen) this.element.requestFullscreen();
  };

  Viewer.prototype.resize = function () {
    var width = this.stage.clientWidth, height = this.stage.clientHeight;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  };

  Viewer.prototype.home = function () {
    var half = this.camera.fov * Math.PI / 360;
    var narrow = Math.atan(Math.tan(half) * Math.min(1, this.camera.aspect));
    var distance = this.scene.reach / Math.sin(narrow);
    this.orbit.target.copy(this.scene.target);
    this.camera.position.copy(this.scene.target).addScaledVector(this.scene.toEye, distance);
    this.orbit.update();
    this.draw();
  };

  Viewer.prototype.draw = function () {
    var scene = this.scene;
    var dark = !!window.matchMedia && window.matchMedia('(prefers-color-scheme: dark)').matches;
    scene.edgeMaterial.color.set(dark ? 0x10141c : 0x2a3550);
    var fingers = scene.show(this.time, this.options);
    // The lamp is above the left shoulder of the eye.
    scene.lamp.position.set(-0.4, 0.5, 1).applyQuaternion(this.camera.quaternion).multiplyScalar(scene.reach)
        .add(scene.target);
    scene.lamp.target.position.copy(scene.target);
    this.renderer.render(scene.root, this.camera);
    this.showText(fingers);
    this.showLabels();
  };

  Viewer.prototype.showText = function (fingers) {
    var replay = this.scene.replay, index = this.stepNow(), step = this.steps[index];
    var last = this.steps[this.steps.length - 1].number;
    var failed = !!this.data.failure && this.time >= this.end - 1e-6;
    this.stepLine.textContent = (step.number === 0 ? '' : 'Step ' + step.number + ' of ' + last + ' \u00b7 ') + step.title;
    var text = this.time.toFixed(2) + ' s' + (this.data.simulatedTime ? '' : ' (not the time of the simulation)');
    if (replay.turns) text += ' \u00b7 rotated ' + degrees(replay.turned()) + ' of ' + degrees(this.data.goalTurn);
    this.timeLine.textContent = text;
    this.banner.style.display = failed ? '' : 'none';
    this.slider.value = this.time;
    this.element.setAttribute('data-time', this.time.toFixed(3));
    this.element.setAttribute('data-step', step.number);
    this.stepButtons.forEach(function (one, i) { one.classList.toggle('now', i === index); });
    // A step that fails the analytic check is not replayed, and has no forces.
    var known = fingers.some(function (finger) { return finger.state === 2 && finger.force > 0; });
    this.rows.forEach(function (row, i) {
      var now = fingers[i], holds = now.state === 2;
      row.row.className = holds ? '' : 'free';
      row.force.textContent = !holds ? 'not in contact' : known ? forceText(now.force) : 'not replayed';
      row.margin.textContent = holds && now.margin !== null ? degrees(now.margin) : '\u2013';
    });
  };

  Viewer.prototype.showLabels = function () {
    var viewer = this, width = this.stage.clientWidth, height = this.stage.clientHeight;
    var failed = this.scene.fault.visible, placed = [];
    this.scene.labels.forEach(function (label, i) {
      var element = viewer.labels[i];
      var at = label.position.clone().project(viewer.camera);
      var shown = label.kind === 'mark' ? failed : label.visible && viewer.options.names;
      shown = shown && Math.abs(at.x) < 1 && Math.abs(at.y) < 1 && at.z < 1;
      element.style.display = shown ? '' : 'none';
      if (!shown) return;
      var halfWidth = element.offsetWidth / 2, halfHeight = element.offsetHeight / 2;
      var x = Math.max(halfWidth, Math.min(width - halfWidth, (at.x + 1) / 2 * width));
      var y = (1 - at.y) / 2 * height;
      function overlaps(other) {
        return Math.abs(other.x - x) < other.halfWidth + halfWidth && Math.abs(other.y - y) < other.halfHeight + halfHeight;
      }
      // Labels that would overlap move down.
      for (var other = placed.find(overlaps); other; other = placed.find(overlaps)) {
        y = other.y + other.halfHeight + halfHeight + 1;
      }
      placed.push({x: x, y: y, halfWidth: halfWidth, halfHeight: halfHeight});
      element.style.transform = 'translate(' + x.toFixed(1) + 'px,' + y.toFixed(1) + 'px) translate(-50%,-50%)';
    });
  };

  // ---- Start.

  // The image that replaces a viewer joins the other frames. Its place remains in print.
  function moveStillPicture() {
    var still = document.querySelector('.still figure, .failure figure'), frames = document.querySelector('.frames');
    if (!still || !frames) return;
    var copy = still.cloneNode(true);
    still.removeAttribute('id');
    still.parentNode.classList.add('printed');
    copy.classList.add('screen');
    frames.insertBefore(copy, frames.firstChild);
  }

  var element = document.getElementById('viewer');
  var text = document.getElementById('viewer-data');
  if (!element || !text || !hasWebGl()) return;
  var viewer = new Viewer(element, JSON.parse(text.textContent));
  moveStillPicture();
  element.viewer = viewer;
}());
