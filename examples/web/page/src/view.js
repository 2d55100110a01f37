// The picture: two bodies side by side in one canvas. Positions go from the module's memory to the graphics card
// without a copy in between.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DynamicDrawUsage,
  GridHelper,
  HemisphereLight,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Plane,
  PlaneGeometry,
  Raycaster,
  Scene,
  ShadowMaterial,
  SphereGeometry,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import { colour } from './plots.js';
import { surface } from './surface.js';

const MOST_PINS = 512;

/** One body on the ground. */
class Place {
  constructor() {
    this.scene = new Scene();
    this.sun = new DirectionalLight(0xffffff, 2.4);
    this.sun.position.set(1.2, 3, 1.6);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.normalBias = 0.02;
    Object.assign(this.sun.shadow.camera, { left: -2, right: 2, top: 2, bottom: -2, far: 8 });
    this.light = new HemisphereLight(0xffffff, 0x8a8f86, 1.5);
    this.floor = new Mesh(new PlaneGeometry(40, 40).rotateX(-Math.PI / 2), new ShadowMaterial({ opacity: 0.28 }));
    this.floor.receiveShadow = true;
    this.skin = new MeshStandardMaterial({ roughness: 0.62 });
    this.pins = new InstancedMesh(new SphereGeometry(0.012, 10, 8), new MeshStandardMaterial(), MOST_PINS);
    this.pins.frustumCulled = false;
    this.scene.add(this.sun, this.light, this.floor, this.pins);
  }

  setBody(triangles) {
    if (this.mesh) this.scene.remove(this.mesh);
    this.mesh?.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(triangles, 1));
    this.mesh = new Mesh(geometry, this.skin);
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  update(positions, pinned) {
    const { geometry } = this.mesh;
    if (geometry.getAttribute('position')?.array !== positions) {
      geometry.deleteAttribute('normal');
      geometry.setAttribute('position', new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage));
    }
    geometry.getAttribute('position').needsUpdate = true;
    geometry.computeVertexNormals();
    const matrix = new Matrix4();
    this.pins.count = Math.min(MOST_PINS, pinned.size);
    [...pinned].slice(0, MOST_PINS).forEach((node, k) => {
      this.pins.setMatrixAt(k, matrix.setPosition(...positions.subarray(3 * node, 3 * node + 3)));
    });
    this.pins.instanceMatrix.needsUpdate = true;
  }

  paint(tone) {
    this.skin.color.set(tone);
    this.pins.material.color.set(colour('ink'));
    if (this.grid) this.scene.remove(this.grid);
    this.grid = new GridHelper(8, 32, colour('line'), colour('line'));
    this.scene.background = new Color(colour('sky'));
    this.scene.add(this.grid);
  }
}

export class View {
  places = [new Place(), new Place()];
  single = false;

  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.setScissorTest(true);
    this.camera = new PerspectiveCamera(36, 1, 0.05, 60);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.maxPolarAngle = 1.52;
    this.orbit.minDistance = 0.6;
    this.orbit.maxDistance = 12;
    this.ray = new Raycaster();
    this.paint();
    new ResizeObserver(() => this.fit()).observe(canvas);
    this.fit();
  }

  paint() {
    this.places[0].paint(colour('a'));
    this.places[1].paint(colour('b'));
  }

  fit() {
    const { clientWidth, clientHeight } = this.canvas;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / (this.single ? 1 : 2) / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
  }

  /** Looks at a body of this height. */
  setBody(corners, size) {
    const triangles = surface(corners);
    for (const place of this.places) place.setBody(triangles);
    this.nodes = new Set(triangles);
    this.orbit.target.set(0, 0.45 * Math.max(0.7, size), 0);
    // Further away where the picture is narrow.
    this.camera.position.set(1.1, 1.0, 2.6).multiplyScalar(Math.max(1, size) * Math.max(1, 0.85 / this.camera.aspect));
    this.orbit.update();
  }

  /** Goes along with a body that leaves the picture. */
  goAlong(positions) {
    const middle = [0, 2].map((axis) => {
      let sum = 0;
      for (let k = axis; k < positions.length; k += 3) sum += positions[k];
      return (3 * sum) / positions.length;
    });
    this.shift(0.04 * (middle[0] - this.orbit.target.x), 0.04 * (middle[1] - this.orbit.target.z));
  }

  /** Back to where the bodies start. */
  goHome() {
    this.shift(-this.orbit.target.x, -this.orbit.target.z);
  }

  shift(x, z) {
    for (const at of [this.orbit.target, this.camera.position]) at.set(at.x + x, at.y, at.z + z);
  }

  /** Places of the two halves: x and width, in CSS pixels. */
  halves() {
    const { clientWidth: width } = this.canvas;
    return this.single ? [[0, width]] : [[0, width / 2], [width / 2, width / 2]];
  }

  draw(sides, pinned) {
    this.orbit.update();
    const height = this.canvas.clientHeight;
    this.halves().forEach(([x, width], k) => {
      this.places[k].update(sides[k].body.positions, pinned);
      this.renderer.setViewport(x, 0, width, height);
      this.renderer.setScissor(x, 0, width, height);
      this.renderer.render(this.places[k].scene, this.camera);
    });
  }

  /** Aims at a point of the canvas. Returns which half it is in. */
  aim(event) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const half = this.single || x < box.width / 2 ? 0 : 1;
    const [left, width] = this.halves()[half];
    this.ray.setFromCamera(new Vector2((2 * (x - left)) / width - 1, 1 - (2 * y) / box.height), this.camera);
    return half;
  }

  /** The node under the pointer, where it was hit, and in which half; or null. */
  pick(event) {
    const half = this.aim(event);
    const { mesh } = this.places[half];
    mesh.geometry.computeBoundingSphere();
    const [hit] = this.ray.intersectObject(mesh);
    if (!hit) return null;
    const x = mesh.geometry.getAttribute('position');
    const distance = (node) => new Vector3().fromBufferAttribute(x, node).distanceTo(hit.point);
    const [node] = [hit.face.a, hit.face.b, hit.face.c].sort((a, b) => distance(a) - distance(b));
    this.plane = new Plane().setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), hit.point);
    return { half, node, point: hit.point.toArray() };
  }

  /** Where the pointer is in the plane of the last pick. */
  follow(event) {
    this.aim(event);
    return this.ray.ray.intersectPlane(this.plane, new Vector3())?.toArray() ?? null;
  }

  /** A way on the screen as a way in the world. */
  across(right, up) {
    const e = this.camera.matrixWorld.elements;
    return [0, 1, 2].map((axis) => right * e[axis] + up * e[4 + axis]);
  }
}
