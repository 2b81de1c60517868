'use strict';
// The view in the fragment of the page's address, such as
//   #eye=1,2,1.7&look-at=0,0,1&up=0,0,1&fov=50&size=640x480&exposure=0.05&show=radiosity&mesh=1&interface=0
// with the names that the options of `penumbra render` have.

function readVector(text) {
  const numbers = (text || '').split(',').map(Number);
  return numbers.length === 3 && numbers.every(Number.isFinite) ? numbers : null;
}

function readPositive(text) {
  const number = Number(text);
  return text !== null && Number.isFinite(number) && number > 0 ? number : null;
}

// What the fragment asks for; what it leaves out, or says wrongly, is null.
function readAddress(fragment) {
  const fields = new URLSearchParams(fragment.replace(/^#/, ''));
  const size = /^(\d+)x(\d+)$/.exec(fields.get('size') || '');
  const flag = (name) => (fields.has(name) ? fields.get(name) !== '0' : null);
  return {
    camera: fields.get('camera'),
    eye: readVector(fields.get('eye')), lookAt: readVector(fields.get('look-at')), up: readVector(fields.get('up')),
    fov: readPositive(fields.get('fov')), exposure: readPositive(fields.get('exposure')),
    size: size && Number(size[1]) > 0 && Number(size[2]) > 0 ? [Number(size[1]), Number(size[2])] : null,
    show: ['picture', 'radiosity', 'irradiance'].includes(fields.get('show')) ? fields.get('show') : null,
    mesh: flag('mesh'), discontinuities: flag('discontinuities'), walk: flag('walk'), interface: flag('interface'),
  };
}

// A fragment that leads back to this view.
function writeAddress(camera, settings) {
  const digits = (vector) => vector.map((x) => Number(x.toPrecision(7))).join(',');
  const fields = [`eye=${digits(camera.eye)}`, `look-at=${digits(camera.lookAt)}`, `up=${digits(camera.up)}`, `fov=${camera.fov}`,
    `exposure=${Number(settings.exposure.toPrecision(4))}`];
  if (settings.show !== 'picture') fields.push(`show=${settings.show}`);
  for (const name of ['mesh', 'discontinuities', 'walk']) if (settings[name]) fields.push(`${name}=1`);
  return '#' + fields.join('&');
}
