// Measurements inside a page, for bench-pages.
'use strict';

// Time in seconds until the page has drawn the result of a change.
window.secondsOf = (change) => new Promise((done) => {
  const begin = performance.now();
  change();
  requestAnimationFrame(() => setTimeout(() => done((performance.now() - begin) / 1000)));
});

window.sortTable = (column) => window.secondsOf(() => document.querySelectorAll('table.data th button')[column].click());

window.searchTable = (text) => window.secondsOf(() => {
  const field = document.getElementById('filter-text');
  field.value = text;
  field.dispatchEvent(new Event('input'));
});

// Frames per second of the replay, played from its start, and the time in milliseconds that the scripts of the page
// take per frame. The browser draws WebGL in another process.
window.playReplay = (seconds) => new Promise((done) => {
  const viewer = document.getElementById('viewer').viewer;
  const draw = viewer.draw;
  let frames = 0;
  let scripts = 0;
  viewer.draw = function() {
    const start = performance.now();
    draw.apply(this, arguments);
    scripts += performance.now() - start;
    ++frames;
  };
  viewer.setTime(0);
  viewer.toggle();
  frames = scripts = 0;
  const begin = performance.now();
  setTimeout(() => {
    viewer.toggle();
    done([1000 * frames / (performance.now() - begin), scripts / frames]);
  }, 1000 * seconds);
});
