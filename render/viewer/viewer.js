// The 3-D scene of a replay: decodes the data of the page and poses objects at any time.
// Lengths are metres, angles radians, z is up. Classic script, uses the global THREE.
var RegraspScene = (function () {
  'use strict';

  var LARGEST_CODE = 65535;
  var HIDDEN = 0, HOLDING = 2;  // states of a finger; 1 is free
  var NUMBERS_PER_FINGER = 10;
  var HAND_COLOR = 0xd8cfc2, FAULT_RED = 0xd61020;
  var CELLS_PER_REACH = 25;     // cells of coarse surfaces per radius of the visible scene
  var FIRST_JOINT = 8;          // columns before: time, position and quaternion of the object

  function bytesOf(base64) {
    var text = atob(base64);
    var bytes = new Uint8Array(text.length);
    for (var i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  function shortsOf(base64) { return new Uint16Array(bytesOf(base64).buffer); }

  // Returns a function (column, row) that gives a number of a table.
  function tableOf(json, rows) {
    var codes = shortsOf(json.codes);
    var starts = [], next = 0;
    json.low.forEach(function (low, i) {
      starts.push(low === json.high[i] ? -1 : next);
      if (low !== json.high[i]) next += rows;
    });
    return function (column, row) {
      var low = json.low[column];
      if (starts[column] < 0) return low;
      return low + (json.high[column] - low) * codes[starts[column] + row] / LARGEST_CODE;
    };
  }

  function geometryOf(json) {
    var codes = shortsOf(json.positions);
    var positions = new Float32Array(codes.length);
    for (var i = 0; i < codes.length; ++i) positions[i] = json.low[i % 3] + json.unit * codes[i];
    var small = new Int8Array(bytesOf(json.normals).buffer);
    var normals = new Float32Array(small.length);
    for (i = 0; i < small.length; ++i) normals[i] = small[i] / 127;
    var indices = bytesOf(json.indices).buffer;
    var geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
    geometry.setIndex(new THREE.BufferAttribute(
        json.wide ? new Uint32Array(indices) : new Uint16Array(indices), 1));
    geometry.computeBoundingSphere();
    return geometry;
  }

  // Returns the triangles of a coarser surface with the same vertices. In each cell of a grid, one vertex per main
  // direction of normals remains. Triangles within two cells disappear.
  function coarseIndex(geometry, cell) {
    var points = geometry.attributes.position.array, normals = geometry.attributes.normal.array;
    var fine = geometry.index.array, cells = {}, vertices = {}, cellOf = [], vertexOf = [], coarse = [];
    for (var i = 0, vertex = 0; i < points.length; i += 3, ++vertex) {
      var key = Math.floor(points[i] / cell) + ' ' + Math.floor(points[i + 1] / cell) + ' ' + Math.floor(points[i + 2] / cell);
      if (!(key in cells)) cells[key] = vertex;
      var main = 0;
      for (var k = 1; k < 3; ++k) if (Math.abs(normals[i + k]) > Math.abs(normals[i + main])) main = k;
      key += ' ' + main + (normals[i + main] < 0);
      if (!(key in vertices)) vertices[key] = vertex;
      cellOf.push(cells[key.slice(0, key.lastIndexOf(' '))]);
      vertexOf.push(vertices[key]);
    }
    for (i = 0; i < fine.length; i += 3) {
      var a = cellOf[fine[i]], b = cellOf[fine[i + 1]], c = cellOf[fine[i + 2]];
      if (a !== b && b !== c && c !== a) coarse.push(vertexOf[fine[i]], vertexOf[fine[i + 1]], vertexOf[fine[i + 2]]);
    }
    return new THREE.BufferAttribute(new Uint32Array(coarse), 1);
  }

  function linesOf(points, material) {
    var geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points), 3));
    return new THREE.LineSegments(geometry, material);
  }

  function vectorOf(numbers) { return new THREE.Vector3(numbers[0], numbers[1], numbers[2]); }

  function setPose(object, pose) {
    object.position.fromArray(pose, 0);
    object.quaternion.fromArray(pose, 3);
  }

  // ---- The data over time.

  function Replay(data) {
    var replay = this;
    this.data = data;
    this.count = data.samples.count;
    this.value = tableOf(data.samples, this.count);
    this.times = [];
    for (var i = 0; i < this.count; ++i) this.times.push(this.value(0, i));
    this.end = this.times[this.count - 1];
    this.joints = data.hand ? data.hand.joints.length : 0;
    this.turns = data.goalTurn !== null;
    this.row = 0;
    this.share = 0;
    this.lerp = function (column) {
      var a = replay.value(column, replay.row);
      if (replay.share === 0) return a;
      return a + replay.share * (replay.value(column, replay.row + 1) - a);
    };
  }

  // Chooses the two samples around a time.
  Replay.prototype.seek = function (time) {
    var low = 0, high = this.count - 1;
    while (high - low > 1) {
      var middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle; else high = middle;
    }
    if (time >= this.times[high]) low = high;
    var span = low + 1 < this.count ? this.times[low + 1] - this.times[low] : 0;
    this.row = low;
    this.share = span > 0 ? Math.min(1, Math.max(0, (time - this.times[low]) / span)) : 0;
  };

  Replay.prototype.poseAt = function (row, position, quaternion) {
    var v = this.value;
    position.set(v(1, row), v(2, row), v(3, row));
    quaternion.set(v(4, row), v(5, row), v(6, row), v(7, row)).normalize();
  };

  Replay.prototype.pose = function (object) {
    this.poseAt(this.row, object.position, object.quaternion);
    if (this.share === 0) return;
    var position = new THREE.Vector3(), quaternion = new THREE.Quaternion();
    this.poseAt(this.row + 1, position, quaternion);
    object.position.lerp(position, this.share);
    object.quaternion.slerp(quaternion, this.share);
  };

  Replay.prototype.joint = function (index) { return this.lerp(FIRST_JOINT + index); };

  Replay.prototype.turned = function () {
    return this.lerp(FIRST_JOINT + this.joints + NUMBERS_PER_FINGER * this.data.fingers.length);
  };

  // Returns state, contact, inward normal and force of a finger.
  Replay.prototype.finger = function (index) {
    var first = FIRST_JOINT + this.joints + NUMBERS_PER_FINGER * index;
    var value = this.value, row = this.row, lerp = this.lerp;
    var state = Math.round(value(first, row));
    var changes = this.share > 0 && (state === HIDDEN) !== (Math.round(value(first, row + 1)) === HIDDEN);
    var get = changes ? function (column) { return value(column, row); } : lerp;
    var vector = function (at) { return new THREE.Vector3(get(at), get(at + 1), get(at + 2)); };
    return {state: state, point: vector(first + 1), inward: vector(first + 4).normalize(),
            force: vector(first + 7)};
  };

  // ---- The scene.

  function arrow(color, radius) {
    var material = new THREE.MeshBasicMaterial({color: color, depthTest: false, transparent: true,
                                                opacity: 0.92});
    var group = new THREE.Group();
    var shaft = new THREE.Mesh(new THREE.CylinderBufferGeometry(radius, radius, 1, 12), material);
    var head = new THREE.Mesh(new THREE.ConeBufferGeometry(3 * radius, 8 * radius, 16), material);
    shaft.renderOrder = head.renderOrder = 5;
    group.add(shaft, head);
    // Sets the arrow from a point along a vector.
    group.set = function (from, vector) {
      var length = vector.length();
      group.visible = length > 0;
      if (!group.visible) return;
      var neck = Math.max(1e-9, length - 8 * radius);
      shaft.scale.y = neck;
      shaft.position.y = neck / 2;
      head.position.y = length - 4 * radius;
      group.position.copy(from);
      group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), vector.clone().normalize());
    };
    return group;
  }

  // Three arrows along the axes of a frame.
  function triad(length, radius, hidable) {
    var group = new THREE.Group();
    [[0xc8372d, [1, 0, 0]], [0x2f8a3b, [0, 1, 0]], [0x2b62c4, [0, 0, 1]]].forEach(function (axis) {
      var one = arrow(axis[0], radius);
      one.set(new THREE.Vector3(), vectorOf(axis[1]).multiplyScalar(length));
      one.children.forEach(function (part) { part.material.depthTest = hidable; });
      group.add(one);
    });
    return group;
  }

  function Scene(data) {
    this.data = data;
    this.replay = new Replay(data);
    this.root = new THREE.Scene();
    this.size = data.diameter;
    this.labels = [];  // {position, text, color, kind, visible}
    this.largestForce = 0;
    this.addObject();
    this.addHand();
    this.addFingers();
    this.addPaths();
    this.addFailure();
    this.addLights();
    this.frame();
  }

  Scene.prototype.addLights = function () {
    this.sky = new THREE.HemisphereLight(0xffffff, 0xb4b8c2, 0.66);
    this.sky.position.set(0, 0, 1);
    this.lamp = new THREE.DirectionalLight(0xffffff, 0.46);
    this.root.add(this.sky, this.lamp, this.lamp.target);
  };

  Scene.prototype.addObject = function () {
    var data = this.data;
    var geometry = geometryOf(data.object);
    this.surface = new THREE.MeshPhongMaterial({color: 0x94b8e2, specular: 0x202020, shininess: 18,
                                                side: THREE.DoubleSide, polygonOffset: true,
                                                polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    this.object = new THREE.Group();
    this.mesh = new THREE.Mesh(geometry, this.surface);
    this.object.add(this.mesh);
    this.edgeMaterial = new THREE.LineBasicMaterial({color: 0x2a3550});
    if (data.edges) {
      var rows = 0, i, points = [];
      data.edges.low.forEach(function (low, k) { if (low !== data.edges.high[k]) ++rows; });
      rows = rows ? shortsOf(data.edges.codes).length / rows : 0;
      var value = tableOf(data.edges, rows);
      for (i = 0; i < rows; ++i) points.push(value(0, i), value(1, i), value(2, i));
      this.object.add(linesOf(points, this.edgeMaterial));
    }
    this.axes = triad(0.66 * this.size, 0.0085 * this.size, true);
    this.axes.position.copy(vectorOf(data.centroid));
    this.object.add(this.axes);
    this.root.add(this.object);
    this.ghost = this.makeGhost(geometry, 0x707a8a, 0.22);
    this.replay.poseAt(0, this.ghost.position, this.ghost.quaternion);
    this.ghost.visible = false;
  };

  Scene.prototype.makeGhost = function (geometry, color, opacity) {
    var ghost = new THREE.Mesh(geometry, new THREE.MeshPhongMaterial(
        {color: color, transparent: true, opacity: opacity, depthWrite: false}));
    ghost.renderOrder = 2;
    this.root.add(ghost);
    return ghost;
  };

  Scene.prototype.addHand = function () {
    var hand = this.data.hand;
    this.joints = [];
    this.links = [];
    this.tips = {};
    this.palm = new THREE.Group();
    this.root.add(this.palm);
    if (!hand) return;
    setPose(this.palm, hand.pose);
    var scene = this;
    hand.joints.forEach(function (joint) {
      var group = new THREE.Group();
      group.position.copy(vectorOf(joint.offset));
      group.axis = vectorOf(joint.axis);
      group.rest = joint.rest;
      (joint.parent < 0 ? scene.palm : scene.joints[joint.parent]).add(group);
      scene.joints.push(group);
    });
    hand.links.forEach(function (link) {
      var own = link.tip && link.finger >= 0;
      var material = new THREE.MeshPhongMaterial({color: HAND_COLOR, specular: 0x181818, shininess: 12,
                                                  side: THREE.DoubleSide});
      var mesh = new THREE.Mesh(geometryOf(link.mesh), material);
      (link.joint < 0 ? scene.palm : scene.joints[link.joint]).add(mesh);
      scene.links.push(mesh);
      if (own) {
        scene.tips[link.finger] = scene.tips[link.finger] || [];
        scene.tips[link.finger].push(mesh);
      }
    });
    this.palmAxes = triad(0.06, 0.0012, false);
    this.palm.add(this.palmAxes);
  };

  Scene.prototype.addFingers = function () {
    var scene = this, data = this.data, size = this.size;
    var radius = Math.min(data.fingerRadius || 0.03 * size, 0.2 * size);
    var length = 0.14 * size;
    var cone = new THREE.ConeBufferGeometry(length * Math.sin(data.frictionAngle),
                                            length * Math.cos(data.frictionAngle), 32, 1, true);
    cone.translate(0, -length * Math.cos(data.frictionAngle) / 2, 0);  // apex at the origin
    var row, i;
    for (row = 0; row < this.replay.count; ++row) {
      this.replay.row = row;
      for (i = 0; i < data.fingers.length; ++i) {
        var seen = this.replay.finger(i);
        if (seen.state === HOLDING) this.largestForce = Math.max(this.largestForce, seen.force.length());
      }
    }
    this.fingers = data.fingers.map(function (finger, index) {
      var color = new THREE.Color(finger.color);
      var group = new THREE.Group();
      var skin = new THREE.MeshPhongMaterial({color: color, transparent: true, shininess: 30});
      if (!data.hand) {
        var ball = new THREE.Mesh(new THREE.SphereBufferGeometry(radius, 24, 16), skin);
        ball.position.y = -radius;
        var stem = new THREE.Mesh(new THREE.CylinderBufferGeometry(0.45 * radius, 0.45 * radius, 4 * radius, 16), skin);
        stem.position.y = -3.5 * radius;
        group.add(ball, stem);
      }
      var funnel = new THREE.Mesh(cone, new THREE.MeshBasicMaterial(
          {color: color, transparent: true, opacity: 0.28, depthTest: false, side: THREE.DoubleSide}));
      funnel.rotation.x = Math.PI;  // opens along +y, into the object
      funnel.renderOrder = 3;
      group.add(funnel);
      var force = arrow(color.clone().multiplyScalar(0.62), 0.0075 * size);
      scene.root.add(group, force);
      var label = {text: finger.name, color: finger.color, kind: 'finger', position: new THREE.Vector3()};
      scene.labels.push(label);
      return {group: group, skin: skin, cone: funnel, force: force, label: label, color: color,
              number: finger.number, radius: radius};
    });
  };

  // Lines along which the centroid and the ends of the object's axes move.
  Scene.prototype.addPaths = function () {
    var data = this.data, replay = this.replay;
    var points = [[], [], [], []];
    var holder = new THREE.Object3D();
    var ends = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]].map(function (axis) {
      return vectorOf(axis).multiplyScalar(0.66 * data.diameter).add(vectorOf(data.centroid));
    });
    for (var row = 0; row < replay.count; ++row) {
      replay.poseAt(row, holder.position, holder.quaternion);
      holder.updateMatrix();
      for (var k = 0; k < 4; ++k) {
        var at = ends[k].clone().applyMatrix4(holder.matrix);
        if (row > 0) points[k].push(at.x, at.y, at.z);
        if (row + 1 < replay.count) points[k].push(at.x, at.y, at.z);
      }
    }
    this.paths = new THREE.Group();
    [0x606a7c, 0xc8372d, 0x2f8a3b, 0x2b62c4].forEach(function (color, k) {
      this.paths.add(linesOf(points[k], new THREE.LineBasicMaterial({color: color})));
    }, this);
    this.paths.visible = false;
    this.root.add(this.paths);
  };

  Scene.prototype.addFailure = function () {
    var failure = this.data.failure;
    this.fault = new THREE.Group();
    this.root.add(this.fault);
    if (!failure) return;
    var scene = this;
    failure.marks.forEach(function (mark) {
      var color = mark.expected ? 0x007a3d : FAULT_RED;
      var from = vectorOf(mark.from), vector = vectorOf(mark.to).sub(from);
      if (vector.length() > 0) {
        var line = arrow(color, 0.007 * scene.size);
        line.set(from, vector);
        scene.fault.add(line);
      } else {
        var spot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.02 * scene.size, 16, 12),
                                  new THREE.MeshBasicMaterial({color: color, depthTest: false, transparent: true}));
        spot.position.copy(from);
        spot.renderOrder = 6;
        scene.fault.add(spot);
      }
      if (!mark.text) return;
      scene.labels.push({text: mark.text, color: mark.expected ? '#007a3d' : '#d61020', kind: 'mark',
                         position: from.add(vector.multiplyScalar(0.5))});
    });
    if (failure.before) {
      var ghost = this.makeGhost(this.mesh.geometry, 0x007a3d, 0.25);
      setPose(ghost, failure.before);
      this.fault.add(ghost);
    }
  };

  // Chooses the camera: the object and its fingers fill the canvas.
  Scene.prototype.frame = function () {
    var replay = this.replay, centre = vectorOf(this.data.centroid), target = new THREE.Vector3();
    var holder = new THREE.Object3D(), points = [], row, i;
    var stride = Math.max(1, Math.floor(replay.count / 200));
    var used = 0;
    for (row = 0; row < replay.count; row += stride, ++used) {
      replay.poseAt(row, holder.position, holder.quaternion);
      holder.updateMatrix();
      target.add(centre.clone().applyMatrix4(holder.matrix));
      replay.row = row;
      for (i = 0; i < this.fingers.length; ++i) {
        var finger = replay.finger(i);
        if (finger.state === HOLDING) points.push(finger.point);
      }
    }
    target.divideScalar(used);
    var farthest = 0.5 * this.size;
    points.forEach(function (p) { farthest = Math.max(farthest, p.distanceTo(target)); });
    var around = 0.2 * this.size;
    Object.keys(this.tips).forEach(function (finger) {
      this.tips[finger].forEach(function (mesh) {
        around = Math.max(around, Math.min(2 * mesh.geometry.boundingSphere.radius, 0.03));
      });
    }, this);
    this.target = target;
    this.reach = Math.min(farthest, 2 * this.size) + around;
    this.toEye = vectorOf(this.data.toEye).normalize();
    if (this.data.planar || Math.abs(this.toEye.z) > 0.999) this.toEye.set(0, -0.001, 1).normalize();
  };

  // Draws coarse copies of object and links, which are nearly the same at the size of the canvas, or the full meshes.
  Scene.prototype.setCoarse = function (coarse) {
    this.links.concat(this.mesh).forEach(function (mesh) {
      var geometry = mesh.geometry;
      geometry.fine = geometry.fine || geometry.index;
      if (coarse) geometry.coarse = geometry.coarse || coarseIndex(geometry, this.reach / CELLS_PER_REACH);
      geometry.setIndex(coarse ? geometry.coarse : geometry.fine);
    }, this);
  };

  // Poses everything at a time. Returns the fingers as they are then.
  Scene.prototype.show = function (time, options) {
    var scene = this, replay = this.replay, data = this.data;
    replay.seek(time);
    replay.pose(this.object);
    this.joints.forEach(function (joint, i) {
      joint.quaternion.setFromAxisAngle(joint.axis, replay.joint(i) - joint.rest);
    });
    this.root.updateMatrixWorld();
    var failed = data.failure && time >= replay.end - 1e-6;
    this.fault.visible = !!failed;
    this.surface.transparent = options.xray;
    this.surface.opacity = options.xray ? 0.38 : 1;
    this.surface.depthWrite = !options.xray;
    this.ghost.visible = options.ghost;
    this.paths.visible = options.path;
    this.axes.visible = options.axes;
    if (this.palmAxes) this.palmAxes.visible = options.palm;
    this.links.forEach(function (mesh, i) {
      mesh.material.color.set(HAND_COLOR);
      if (failed && data.failure.links.indexOf(i) >= 0) mesh.material.color.lerp(new THREE.Color(FAULT_RED), 0.75);
    });
    return this.fingers.map(function (finger, index) {
      var now = replay.finger(index);
      var wrong = failed && data.failure.fingers.indexOf(index) >= 0;
      scene.showFinger(finger, now, wrong, options);
      var force = now.force.length();
      var angle = force > 0 && now.state === HOLDING ? now.force.angleTo(now.inward) : 0;
      return {name: data.fingers[index].name, color: data.fingers[index].color, state: now.state, force: force,
              margin: data.hardFingers && now.state === HOLDING && force > 1e-3 * scene.largestForce ? data.frictionAngle - angle : null};
    });
  };

  Scene.prototype.showFinger = function (finger, now, wrong, options) {
    var holds = now.state === HOLDING, hand = this.data.hand;
    var red = new THREE.Color(FAULT_RED);
    finger.group.visible = now.state !== HIDDEN;
    finger.group.position.copy(now.point);
    if (now.state !== HIDDEN) finger.group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), now.inward);
    finger.skin.opacity = holds ? 1 : 0.5;
    finger.skin.color.copy(wrong ? red : finger.color);
    finger.cone.visible = options.cones && holds;
    finger.force.visible = false;
    if (options.forces && holds && this.largestForce > 0) {
      finger.force.set(now.point, now.force.clone().multiplyScalar(0.3 * this.size / this.largestForce));
    }
    finger.label.visible = now.state !== HIDDEN;
    finger.label.position.copy(now.point).addScaledVector(now.inward, -6.5 * finger.radius);
    (this.tips[finger.number] || []).forEach(function (mesh) {
      if (holds || wrong) mesh.material.color.lerp(wrong ? red : finger.color, wrong ? 0.75 : 0.5);
      finger.label.position.copy(mesh.geometry.boundingSphere.center).applyMatrix4(mesh.matrixWorld);
      finger.label.visible = !!hand;
    });
  };

  return Scene;
}());
