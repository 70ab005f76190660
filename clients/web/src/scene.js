// The robot and its workcell in three dimensions: solid links made from the outlines of the robot's file,
// blocks, work surface, protected region, the camera's field, tool frame and tool path. It is told what
// is known (model, state) and draws; it knows no server. Lengths are mm, z points up.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { frames, mmPerUnit } from "./kinematics.js";
import { colorOf } from "./palette.js";
import { prisms, segments, strokes, triangles } from "./solids.js";

const kMostPathPoints = 4096;
const kJumpDegrees = 25; // more than that at once is a jump (home, reset), not a motion
const kLongestGlideMs = 120;
const kFill = 0.92; // of the distance at which everything is surely in the picture

const matrixOf = (rows) => new THREE.Matrix4().set(...rows.flat());
const mix = (a, b, t) => a + (b - a) * t;

const themes = {
  light: { background: 0xeef1f4, floor: 0xdfe4e9, line: 0xb9c2cb, edge: 0x2b3138, accent: 0xd9622b },
  dark: { background: 0x11161c, floor: 0x1a2129, line: 0x303a45, edge: 0x05080b, accent: 0xff8a3d },
};

export class Scene {
  /** @param {HTMLElement} host filled by the canvas, whatever its size */
  constructor(host) {
    this.host = host;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.domElement.setAttribute("role", "img");
    this.renderer.domElement.setAttribute("aria-label", "The robot and its workcell in three dimensions");
    this.renderer.domElement.tabIndex = 0;
    host.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 10, 20000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableDamping = true;
    this.controls.listenToKeyEvents(this.renderer.domElement);
    this.controls.addEventListener("change", () => this.#wake());
    this.#light();
    this.robot = new THREE.Group();
    this.robot.name = "robot";
    this.cell = new THREE.Group();
    this.cell.name = "workcell";
    this.blocks = new THREE.Group();
    this.blocks.name = "blocks";
    this.scene.add(this.robot, this.cell, this.blocks);
    this.shows = { region: true, field: true, frame: true, path: true };
    this.glide = null;
    this.values = [];
    this.pathPoints = [];
    this.theme = "light";
    new ResizeObserver(() => this.#resize()).observe(host);
    this.#resize();
  }

  #light() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a949e, 1.6));
    const sun = new THREE.DirectionalLight(0xffffff, 1.9);
    sun.position.set(900, -700, 1600);
    const fill = new THREE.DirectionalLight(0xcfe0ff, 0.5);
    fill.position.set(-800, 900, 500);
    this.scene.add(sun, fill);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.#wake();
  }

  setTheme(name) {
    this.theme = name;
    this.scene.background = new THREE.Color(themes[name].background);
    if (this.model) this.setModel(this.model);
    this.#wake();
  }

  // --- The model.

  setModel(model) {
    const isNew = this.model?.robot.name !== model.robot.name;
    this.model = model;
    this.unit = mmPerUnit(model.robot);
    this.#buildRobot(model.robot);
    this.#buildCell(model.robot, model.workcell);
    this.mustLook = this.mustLook || isNew;
    if (this.state) this.#pose();
  }

  #solid(outline, colorIndex, shift = 0) {
    const group = new THREE.Group();
    const all = strokes(outline, this.unit);
    const points = prisms(all).flatMap((prism) =>
      triangles(prism, (flat) =>
        THREE.ShapeUtils.triangulateShape(flat.map(([x, y]) => new THREE.Vector2(x, y)), [])),
    );
    if (points.length > 0) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
      geometry.computeVertexNormals();
      const material = new THREE.MeshLambertMaterial({
        color: colorOf(colorIndex), side: THREE.DoubleSide, flatShading: true,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      });
      group.add(new THREE.Mesh(geometry, material));
    }
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(segments(all).flat(), 3));
    const isBare = points.length === 0;
    group.add(new THREE.LineSegments(lines, new THREE.LineBasicMaterial({
      color: isBare ? colorOf(colorIndex) : themes[this.theme].edge, transparent: true, opacity: isBare ? 1 : 0.75,
    })));
    group.position.y = shift;
    return group;
  }

  #buildRobot(robot) {
    this.robot.clear();
    this.links = robot.links.map((link, k) => {
      const group = new THREE.Group();
      group.name = `link${k}`;
      group.matrixAutoUpdate = false;
      group.add(this.#solid(link.points, link.color));
      this.robot.add(group);
      return group;
    });
    this.fingers = robot.tool.parts.map((part) => {
      const finger = this.#solid(part.points, part.color);
      finger.userData = { side: part.side, pivot: (part.pivot ?? [0, 0, 0]).map((x) => x * this.unit) };
      this.links.at(-1).add(finger);
      return finger;
    });
    this.frameAxes = new THREE.AxesHelper(60);
    this.frameAxes.name = "tool frame";
    this.links.at(-1).add(this.frameAxes);
    this.tipMark = new THREE.Object3D();
    this.tipMark.name = "tip";
    this.links.at(-1).add(this.tipMark);
    this.#applyShows();
  }

  #buildCell(robot, workcell) {
    const theme = themes[this.theme];
    const unit = mmPerUnit(workcell);
    this.cell.clear();
    const height = (workcell.work_surface ?? 0) * unit;
    const [x, y] = [workcell.workspace.x * unit, workcell.workspace.y * unit];
    const reach = Math.max(x, y) * 1.25;
    const floor = new THREE.Mesh(
      new THREE.PlaneGeometry(2 * reach, 2 * reach),
      new THREE.MeshBasicMaterial({ color: theme.floor, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }),
    );
    floor.position.z = height - 0.5;
    const grid = new THREE.GridHelper(2 * reach, Math.round((2 * reach) / 50), theme.line, theme.line);
    grid.rotation.x = Math.PI / 2;
    grid.position.z = height;
    grid.material.transparent = true;
    grid.material.opacity = 0.55;
    floor.name = "work surface";
    this.cell.add(floor, grid, this.#workspaceBorder(x, y, height));
    this.region = this.#region(robot.protected_region);
    this.field = workcell.camera ? this.#cameraField(workcell.camera, unit, height) : null;
    this.cell.add(this.region);
    if (this.field) this.cell.add(this.field);
    this.path = new THREE.Line(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: theme.accent }),
    );
    this.path.name = "tool path";
    this.path.frustumCulled = false;
    this.cell.add(this.path);
    this.#drawPath();
    this.#applyShows();
  }

  #workspaceBorder(x, y, z) {
    const corners = [[0, -y], [x, -y], [x, y], [0, y], [0, -y]].map(([u, v]) => new THREE.Vector3(u, v, z + 0.5));
    return new THREE.Line(
      new THREE.BufferGeometry().setFromPoints(corners),
      new THREE.LineBasicMaterial({ color: themes[this.theme].accent, transparent: true, opacity: 0.5 }),
    );
  }

  #region({ radius, height }) {
    const [r, h] = [radius * this.unit, height * this.unit];
    const shape = new THREE.CylinderGeometry(r, r, h, 48, 1, true);
    shape.rotateX(Math.PI / 2);
    shape.translate(0, 0, h / 2);
    const group = new THREE.Group();
    group.name = "protected region";
    const color = 0xd0443a;
    group.add(new THREE.Mesh(shape, new THREE.MeshBasicMaterial({
      color, transparent: true, opacity: 0.09, side: THREE.DoubleSide, depthWrite: false,
    })));
    for (const z of [0.8, h]) {
      const ring = Array.from({ length: 65 }, (_, i) => {
        const angle = (i / 64) * 2 * Math.PI;
        return new THREE.Vector3(r * Math.cos(angle), r * Math.sin(angle), z);
      });
      group.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(ring),
        new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.45 })));
    }
    return group;
  }

  #cameraField(camera, unit, height) {
    const [cx, cy, cz] = camera.location.map((v) => v * unit);
    const [w, h] = camera.field.map((v) => (v * unit) / 2);
    const corners = [[cx - w, cy - h], [cx + w, cy - h], [cx + w, cy + h], [cx - w, cy + h]];
    const eye = new THREE.Vector3(cx, cy, cz);
    const ground = corners.map(([u, v]) => new THREE.Vector3(u, v, height + 0.7));
    const upper = camera.projection === "perspective" ? ground.map(() => eye)
      : corners.map(([u, v]) => new THREE.Vector3(u, v, cz));
    const points = ground.flatMap((point, i) => [point, ground[(i + 1) % 4], point, upper[i]]);
    const lines = new THREE.LineSegments(
      new THREE.BufferGeometry().setFromPoints(points),
      new THREE.LineDashedMaterial({ color: 0x3b82d6, dashSize: 12, gapSize: 8, transparent: true, opacity: 0.55 }),
    );
    lines.computeLineDistances();
    lines.name = "camera field";
    return lines;
  }

  show(what, isShown) {
    this.shows[what] = isShown;
    this.#applyShows();
    this.#wake();
  }

  #applyShows() {
    if (this.region) this.region.visible = this.shows.region;
    if (this.field) this.field.visible = this.shows.field;
    if (this.frameAxes) this.frameAxes.visible = this.shows.frame;
    if (this.path) this.path.visible = this.shows.path;
  }

  // --- The state.

  setState(state) {
    const now = performance.now();
    const isFirst = !this.state || this.state.epoch !== state.epoch;
    const wanted = [...state.joints.map((joint) => joint.value), state.tool.value];
    const jumps = this.values.length !== wanted.length ||
      wanted.some((value, i) => Math.abs(value - this.values[i]) > kJumpDegrees);
    const duration = isFirst || jumps ? 0 : Math.min(now - (this.arrival ?? now), kLongestGlideMs);
    this.arrival = now;
    this.state = state;
    this.glide = { from: [...this.values], to: wanted, since: now, duration };
    if (isFirst) this.pathPoints = [];
    if (this.mustLook && this.model) {
      this.mustLook = false;
      this.lookFrom("corner");
    }
    this.#wake();
  }

  /** Joint values, and the tool's, that are drawn at a moment. */
  #valuesAt(now) {
    const { from, to, since, duration } = this.glide;
    const t = duration > 0 ? Math.min((now - since) / duration, 1) : 1;
    if (t >= 1 || from.length !== to.length) return [to, true];
    return [to.map((value, i) => mix(from[i], value, t)), false];
  }

  #pose() {
    if (!this.model || !this.state || !this.glide) return true;
    const [values, isThere] = this.#valuesAt(performance.now());
    this.values = values;
    frames(this.model.robot, values).forEach((frame, k) => {
      this.links[k].matrix.copy(matrixOf(frame));
      this.links[k].matrixWorldNeedsUpdate = true;
    });
    this.#poseFingers(values.at(-1));
    this.#poseBlocks();
    this.#extendPath();
    return isThere;
  }

  #poseFingers(opening) {
    const isParallel = this.model.robot.tool.kind === "parallel";
    for (const finger of this.fingers) {
      const { side, pivot } = finger.userData;
      if (isParallel) {
        finger.position.y = (side * opening) / 2;
        continue;
      }
      finger.rotation.x = THREE.MathUtils.degToRad((side * opening) / 2);
      const shift = new THREE.Vector3(...pivot);
      finger.position.copy(shift).sub(shift.clone().applyEuler(finger.rotation));
    }
  }

  #poseBlocks() {
    const sizes = new Map(this.model.workcell.blocks.map((block) => [block.name, block]));
    const wanted = new Set(this.state.blocks.map((block) => block.name));
    for (const mesh of [...this.blocks.children]) if (!wanted.has(mesh.name)) this.blocks.remove(mesh);
    for (const block of this.state.blocks) {
      const file = sizes.get(block.name);
      if (file) this.#poseBlock(block, this.#blockMesh(file));
    }
  }

  #blockMesh(file) {
    const key = JSON.stringify([file.size, file.color, this.theme]);
    let mesh = this.blocks.getObjectByName(file.name);
    if (mesh?.userData.key === key) return mesh;
    if (mesh) this.blocks.remove(mesh);
    const unit = mmPerUnit(this.model.workcell);
    const shape = new THREE.BoxGeometry(...file.size.map((v) => v * unit));
    mesh = new THREE.Mesh(shape, new THREE.MeshLambertMaterial({
      color: colorOf(file.color), polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(shape),
      new THREE.LineBasicMaterial({ color: themes[this.theme].edge, transparent: true, opacity: 0.7 })));
    mesh.name = file.name;
    mesh.userData = { key };
    mesh.matrixAutoUpdate = false;
    this.blocks.add(mesh);
    return mesh;
  }

  // A held block is rigid in the tool's frame, tilt included: it keeps the pose that it had when it was
  // seen held first.
  #poseBlock(block, mesh) {
    const tool = this.links.at(-1).matrix;
    if (block.held && mesh.userData.inTool) {
      mesh.matrix.multiplyMatrices(tool, mesh.userData.inTool);
    } else {
      mesh.matrix.makeRotationZ(THREE.MathUtils.degToRad(block.yaw_deg));
      mesh.matrix.setPosition(...block.xyz_mm);
      mesh.userData.inTool = block.held ? tool.clone().invert().multiply(mesh.matrix) : null;
    }
    mesh.matrixWorldNeedsUpdate = true;
  }

  #extendPath() {
    const tip = new THREE.Vector3().setFromMatrixPosition(this.links.at(-1).matrix);
    const last = this.pathPoints.at(-1);
    if (last && last.distanceTo(tip) < 0.5) return;
    this.pathPoints.push(tip);
    if (this.pathPoints.length > kMostPathPoints) this.pathPoints.shift();
    this.#drawPath();
  }

  #drawPath() {
    this.path.geometry.dispose();
    this.path.geometry = new THREE.BufferGeometry().setFromPoints(this.pathPoints);
  }

  clearPath() {
    this.pathPoints = [];
    this.#drawPath();
    this.#wake();
  }

  // --- Looking.

  lookFrom(name) {
    this.#pose();
    const box = new THREE.Box3().setFromObject(this.robot).union(new THREE.Box3().setFromObject(this.blocks));
    if (box.isEmpty()) box.set(new THREE.Vector3(-200, -400, 0), new THREE.Vector3(600, 400, 600));
    const ball = box.getBoundingSphere(new THREE.Sphere());
    const away = {
      corner: [1.25, -1.1, 0.75], front: [1, 0, 0.12], left: [0, 1, 0.12], right: [0, -1, 0.12], top: [0.001, 0, 1],
    }[name];
    const narrow = Math.min(1, this.camera.aspect);
    const reach = ball.radius / Math.sin(THREE.MathUtils.degToRad(this.camera.fov / 2)) / narrow;
    const target = ball.center;
    this.camera.position.set(...away).setLength(reach * kFill).add(target);
    this.controls.target.copy(target);
    this.controls.update();
    this.#wake();
  }

  // --- Drawing, only while something changes.

  #wake() {
    if (this.isAwake) return;
    this.isAwake = true;
    requestAnimationFrame(() => this.#draw());
  }

  #draw() {
    this.isAwake = false;
    const isThere = this.#pose();
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
    if (!isThere) this.#wake();
  }

  /** Where the tip is drawn, mm: read back from the scene graph. */
  tipDrawn() {
    if (!this.tipMark) return null;
    this.scene.updateMatrixWorld(true);
    return new THREE.Vector3().setFromMatrixPosition(this.tipMark.matrixWorld).toArray();
  }
  /** Where a block is drawn, mm. */
  blockDrawn(name) {
    const mesh = this.blocks.getObjectByName(name);
    return mesh ? new THREE.Vector3().setFromMatrixPosition(mesh.matrix).toArray() : null;
  }
}
