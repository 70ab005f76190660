// A page that shows an exported robot by urdf-loader, and the robot of xr3's page beside it, from one camera.
import * as THREE from "three";
import URDFLoader from "urdf-loader";
import { RobotBody } from "../../../clients/web/src/scene/robot_body.js";
import { Turntable } from "../../../clients/web/src/scene/turntable.js";

const kSizePx = 400;
const kMetresPerMm = 0.001;
const kSideways = new THREE.Vector3(1, -1.4, 0.8);

async function load(url) {
  const manager = new THREE.LoadingManager();
  const loaded = new Promise((resolve) => { manager.onLoad = resolve; });
  const robot = await new URDFLoader(manager).loadAsync(url);
  await loaded; // the meshes, too
  return robot;
}

/** The robot as xr3's page draws it, in metres. `values`: of the joints, then of the tool. */
function ofThePage(robot, values, turn) {
  const [body, table] = [new RobotBody(), new Turntable()];
  body.build(robot, "light");
  body.pose(values);
  body.showFrame(false);
  table.build(robot, "light");
  table.pose(turn);
  const group = new THREE.Group().add(body.group, table.group);
  group.scale.setScalar(kMetresPerMm);
  return group;
}

function cameraFor(box) {
  const [middle, radius] = [box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3()).length() / 2];
  const camera = new THREE.OrthographicCamera(-radius, radius, radius, -radius, 0.01, 10 * radius);
  camera.up.set(0, 0, 1);
  camera.position.copy(middle).addScaledVector(kSideways.clone().normalize(), 4 * radius);
  camera.lookAt(middle);
  return camera;
}

function sceneOf(object) {
  const scene = new THREE.Scene().add(object, new THREE.HemisphereLight(0xffffff, 0x555555, 2.5));
  scene.background = new THREE.Color(0xffffff);
  return scene;
}

function picture(object, camera) {
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(kSizePx, kSizePx);
  renderer.render(sceneOf(object), camera);
  document.body.append(renderer.domElement);
  return renderer;
}

/** The pixels that faces cover, without lines. */
function shapeOf(object, camera, renderer) {
  const scene = sceneOf(object);
  scene.traverse((each) => { each.visible = !each.isLineSegments; });
  const target = new THREE.WebGLRenderTarget(kSizePx, kSizePx);
  const pixels = new Uint8Array(4 * kSizePx * kSizePx);
  renderer.setRenderTarget(target);
  scene.overrideMaterial = new THREE.MeshBasicMaterial({ color: 0, side: THREE.DoubleSide });
  renderer.render(scene, camera);
  renderer.readRenderTargetPixels(target, 0, 0, kSizePx, kSizePx, pixels);
  return Array.from({ length: kSizePx * kSizePx }, (_, i) => pixels[4 * i] < 128);
}

const count = (shape, of) => shape.filter(of).length;

/** Poses both robots, draws them, and compares. `joints`: of the exported robot, metres and radians. */
window.compare = async (url, joints, robot, values, turn) => {
  const exported = await load(url);
  for (const [name, value] of Object.entries(joints)) exported.setJointValue(name, value);
  exported.updateMatrixWorld(true);
  const own = ofThePage(robot, values, turn);
  own.updateMatrixWorld(true);
  const camera = cameraFor(new THREE.Box3().setFromObject(exported));
  const [shape, wanted] = [exported, own].map((each) => shapeOf(each, camera, picture(each, camera)));
  const placeOf = (name) => new THREE.Vector3().setFromMatrixPosition(exported.links[name].matrixWorld).toArray();
  return {
    joints: Object.keys(exported.joints).filter((name) => exported.joints[name].jointType !== "fixed"),
    tool: placeOf("tool"),
    fingers: [placeOf("finger_1"), placeOf("finger_2")],
    drawn: count(shape, (isIn) => isIn),
    different: count(shape, (isIn, i) => isIn !== wanted[i]),
  };
};
