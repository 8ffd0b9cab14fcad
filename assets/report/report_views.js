// The views in three dimensions: objects with colours at their vertices, and one that turns as it did.

function bytes_of(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}
function numbers_of(text, Kind) { const bytes = bytes_of(text); return new Kind(bytes.buffer, 0, bytes.length / Kind.BYTES_PER_ELEMENT); }

// Geometry of an object, made when it is first shown.
const geometries = new Map();
function geometry_of(object, index) {
  if (!object.mesh) return null;
  if (!geometries.has(index)) {
    const mesh = object.mesh, coded = numbers_of(mesh.positions, Uint16Array), places = new Float32Array(coded.length);
    for (let i = 0; i < coded.length; ++i) {
      const axis = i % 3;
      places[i] = mesh.low[axis] + coded[i] / 65535 * (mesh.high[axis] - mesh.low[axis]);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
    geometry.setIndex(new THREE.BufferAttribute(numbers_of(mesh.triangles, mesh.wide ? Uint32Array : Uint16Array), 1));
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
    geometry.userData = {visible: bytes_of(mesh.visible)};
    geometries.set(index, geometry);
  }
  return geometries.get(index);
}

function renderer_in(stage) {
  let renderer;
  try { renderer = new THREE.WebGLRenderer({antialias: true, alpha: true, preserveDrawingBuffer: true}); } catch (failure) {
    stage.append(element('p', {class: 'note'}, 'This browser shows no WebGL: the maps are in the folder of surfaces, too.'));
    return null;
  }
  // The page's own ground shows through, by day, by night and on paper.
  renderer.setClearColor(0xffffff, 0);
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
  stage.prepend(renderer.domElement);
  return renderer;
}

function fit(renderer, camera, stage) {
  const width = stage.clientWidth, height = stage.clientHeight;
  if (!width || !height) return;
  renderer.setSize(width, height, false);
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
}

function lit(scene, camera) {
  // A lamp beside the viewer: it shows the shape and leaves the colours readable.
  const lamp = new THREE.DirectionalLight(0xffffff, 0.45);
  lamp.position.set(0.4, 0.5, 1);
  camera.add(lamp);
  scene.add(camera, new THREE.AmbientLight(0xffffff, 0.62));
}

// One orbit for all linked views: angles about the object and a distance in radii.
const orbit = {turn: 0, tilt: 0.12, away: 4.7, views: [],
  change(turn, tilt, factor) {
    this.turn += turn;
    this.tilt = Math.max(-1.5, Math.min(1.5, this.tilt + tilt));
    this.away = Math.max(1.2, Math.min(12, this.away * factor));
    this.show();
  },
  look(turn) { this.turn = turn; this.tilt = 0.12; this.away = 4.7; this.show(); },
  show() { for (const view of this.views) view.draw(); }};

class MapView {
  constructor(stage, caption) {
    this.stage = stage;
    this.caption = caption;
    this.renderer = renderer_in(stage);
    this.camera = new THREE.PerspectiveCamera(26, 1, 0.01, 100);
    this.scene = new THREE.Scene();
    lit(this.scene, this.camera);
    this.mesh = null;
    orbit.views.push(this);
    if (!this.renderer) return;
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'Object with the density of gaze; arrows turn it');
    let from = null, moved = 0;
    canvas.addEventListener('pointerdown', e => { from = [e.clientX, e.clientY]; moved = 0; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener('pointermove', e => {
      if (!from) return;
      moved += Math.abs(e.clientX - from[0]) + Math.abs(e.clientY - from[1]);
      orbit.change((from[0] - e.clientX) * 0.008, (e.clientY - from[1]) * 0.008, 1);
      from = [e.clientX, e.clientY];
    });
    canvas.addEventListener('pointerup', e => { from = null; if (moved < 4) this.tell(e); });
    canvas.addEventListener('wheel', e => { e.preventDefault(); orbit.change(0, 0, Math.exp(e.deltaY * 0.001)); }, {passive: false});
    canvas.addEventListener('keydown', e => {
      const does = {ArrowLeft: [0.1, 0, 1], ArrowRight: [-0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1],
                    '+': [0, 0, 0.9], '-': [0, 0, 1.1]}[e.key];
      if (e.key === 'Home') orbit.look(0); else if (does) orbit.change(...does); else return;
      e.preventDefault();
    });
    new ResizeObserver(() => this.draw()).observe(stage);
  }

  // `values` from 0 to 1 by vertex (null: nothing), `table` the colours; `tell(value)` says what a value means.
  show(geometry, values, colours, meaning) {
    if (this.mesh) { this.scene.remove(this.mesh); this.mesh.geometry.dispose(); }
    this.mesh = null;
    this.values = values;
    this.meaning = meaning;
    if (geometry) {
      const own = new THREE.BufferGeometry();
      for (const name of ['position', 'normal']) own.setAttribute(name, geometry.getAttribute(name));
      own.setIndex(geometry.getIndex());
      own.boundingSphere = geometry.boundingSphere;
      const count = geometry.getAttribute('position').count, rgb = new Float32Array(3 * count);
      for (let v = 0; v < count; ++v) {
        const at = values && geometry.userData.visible[v] ? 3 * Math.round(255 * Math.max(0, Math.min(1, values[v]))) : -1;
        for (let c = 0; c < 3; ++c) rgb[3 * v + c] = (at < 0 ? 150 : colours[at + c]) / 255;
      }
      own.setAttribute('color', new THREE.BufferAttribute(rgb, 3));
      this.mesh = new THREE.Mesh(own, new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide}));
      this.visible = geometry.userData.visible;
      this.scene.add(this.mesh);
    }
    this.draw();
  }

  draw() {
    if (!this.renderer) return;
    fit(this.renderer, this.camera, this.stage);
    if (this.mesh) {
      const {center, radius} = this.mesh.geometry.boundingSphere, away = orbit.away * radius;
      // The front of an object looks towards -y, and +z is up.
      this.camera.up.set(0, 0, 1);
      this.camera.position.set(center.x + away * Math.sin(orbit.turn) * Math.cos(orbit.tilt),
                               center.y - away * Math.cos(orbit.turn) * Math.cos(orbit.tilt),
                               center.z + away * Math.sin(orbit.tilt));
      this.camera.near = 0.05 * away;
      this.camera.far = away + 4 * radius;
      this.camera.updateProjectionMatrix();
      this.camera.lookAt(center);
    }
    this.renderer.render(this.scene, this.camera);
  }

  // The view as it is turned, so many dots wide, on white.
  picture(width) {
    const ratio = this.renderer.getPixelRatio(), source = this.renderer.domElement;
    this.renderer.setPixelRatio(width / this.stage.clientWidth);
    this.draw();
    const canvas = element('canvas', {width: source.width, height: source.height}), paint = canvas.getContext('2d');
    paint.fillStyle = '#ffffff';
    paint.fillRect(0, 0, canvas.width, canvas.height);
    paint.drawImage(source, 0, 0);
    this.renderer.setPixelRatio(ratio);
    this.draw();
    return canvas;
  }

  tell(event) {
    if (!this.mesh || !this.values) return;
    const box = this.stage.getBoundingClientRect(), caster = new THREE.Raycaster();
    caster.setFromCamera({x: (event.clientX - box.left) / box.width * 2 - 1, y: 1 - (event.clientY - box.top) / box.height * 2}, this.camera);
    const hit = caster.intersectObject(this.mesh)[0];
    if (!hit) return;
    const v = hit.face.a;
    this.caption.lastChild.textContent = ' Here: ' + (this.visible[v] ? this.meaning(this.values[v], v) : 'never visible') + '.';
  }
}

// An object as it turned in a trial, seen through the study's own camera.
class TrialView {
  constructor(stage) {
    this.stage = stage;
    this.renderer = renderer_in(stage);
    this.camera = new THREE.PerspectiveCamera(12, 1, 0.01, 100);
    this.scene = new THREE.Scene();
    lit(this.scene, this.camera);
    this.overlay = shape('svg', {viewBox: '0 0 1000 1000', preserveAspectRatio: 'none'});
    stage.append(this.overlay);
    this.mesh = null;
    if (this.renderer) new ResizeObserver(() => this.draw && this.redraw && this.redraw()).observe(stage);
  }

  load(object, index) {
    if (this.mesh) this.scene.remove(this.mesh);
    this.mesh = null;
    this.object = object;
    const geometry = geometry_of(object, index);
    // Without an object the whole screen is shown, in its own shape.
    this.shown = geometry ? {origin: object.origin, size: object.image} : {origin: [0, 0], size: object.screen};
    this.height = geometry ? 1000 : 1000 * object.screen[1] / object.screen[0];
    this.overlay.setAttribute('viewBox', `0 0 1000 ${this.height}`);
    this.stage.style.aspectRatio = geometry ? '' : `${object.screen[0]} / ${object.screen[1]}`;
    if (!geometry) return;
    this.mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({color: 0xc9b48a, side: THREE.DoubleSide}));
    this.mesh.matrixAutoUpdate = false;
    this.scene.add(this.mesh);
    const {radius} = geometry.boundingSphere, place = new THREE.Vector3(...object.camera);
    const away = place.distanceTo(new THREE.Vector3(...object.target));
    this.camera.fov = object.fov;
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(place);
    this.camera.near = Math.max(0.01 * away, away - 3 * radius);
    this.camera.far = away + 4 * radius;
    this.camera.lookAt(new THREE.Vector3(...object.target));
  }

  on_stage([x, y]) {
    const {origin, size} = this.shown;
    return [(x - origin[0]) / size[0] * 1000, (y - origin[1]) / size[1] * this.height];
  }

  // Outlines of areas of the screen, each {name, shape, points}.
  draw_areas(areas) {
    for (const {name, shape: kind, points} of areas) {
      const corners = points.map(point => this.on_stage(point)), style = {fill: 'none', stroke: 'var(--mark)', 'stroke-width': 2, 'stroke-dasharray': '8 5'};
      const [[left, top], [right, bottom]] = [0, 1].map(end => [0, 1].map(axis => (end ? Math.max : Math.min)(...corners.map(corner => corner[axis]))));
      this.overlay.append(kind === 'ellipse' ? shape('ellipse', {cx: (left + right) / 2, cy: (top + bottom) / 2, rx: (right - left) / 2, ry: (bottom - top) / 2, ...style})
          : kind === 'polygon' ? shape('polygon', {points: corners.map(c => c.join(',')).join(' '), ...style})
          : shape('rect', {x: left, y: top, width: right - left, height: bottom - top, ...style}),
          shape('text', {x: (left + right) / 2, y: Math.max(18, top + 18), 'text-anchor': 'middle'}, name));
    }
  }

  // Draws the object at an angle, areas of the screen, and circles: {position or place, number, radius, now, counted}.
  draw(angle_deg, circles, areas = []) {
    while (this.overlay.firstChild) this.overlay.firstChild.remove();
    if (this.renderer) fit(this.renderer, this.camera, this.stage);
    let turned = null;
    if (this.mesh) {
      const [x, y] = this.object.axis;
      turned = new THREE.Matrix4().makeTranslation(x, y, 0)
                   .multiply(new THREE.Matrix4().makeRotationZ(angle_deg * Math.PI / 180))
                   .multiply(new THREE.Matrix4().makeTranslation(-x, -y, 0));
      this.mesh.matrix.copy(turned);
      this.mesh.matrixWorldNeedsUpdate = true;
    }
    if (this.renderer) this.renderer.render(this.scene, this.camera);
    this.draw_areas(areas);
    const places = circles.map(circle => {
      if (circle.position && turned) {
        const p = new THREE.Vector3(...circle.position).applyMatrix4(turned).project(this.camera);
        return [500 * (p.x + 1), 500 * (1 - p.y)];
      }
      return this.on_stage(circle.place);
    });
    for (let i = 1; i < places.length; ++i)
      this.overlay.append(shape('line', {x1: places[i - 1][0], y1: places[i - 1][1], x2: places[i][0], y2: places[i][1],
                                         stroke: 'var(--mark)', 'stroke-width': 2, opacity: 0.5}));
    circles.forEach((circle, i) => {
      const [x, y] = places[i];
      this.overlay.append(shape('circle', {cx: x, cy: y, r: circle.radius, fill: circle.now ? '#d55e00' : '#1f5fa8',
                                           'fill-opacity': circle.counted ? 0.45 : 0.08, stroke: circle.now ? '#d55e00' : '#0d3d73',
                                           'stroke-width': 2, 'stroke-dasharray': circle.counted ? '' : '5 4'}));
      const text = shape('text', {x, y: y + 6, 'text-anchor': 'middle'}, circle.number);
      this.overlay.append(text);
    });
  }
}
