// Converts an outline to meshes: the faces that `solids.js` finds in it, with its strokes as edges.
// An outline without faces is drawn as lines in its own colour.
import * as THREE from "three";
import { colorOf } from "../lib/palette.js";
import { prisms, segments, strokes, triangles } from "./solids.js";

// Offsets faces behind their edges, which lie in the same planes.
const kBehindEdges = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };

const kLayerUnits = 16;

export const faceMaterial = (colorIndex, more = {}) =>
  new THREE.MeshLambertMaterial({ color: colorOf(colorIndex), ...kBehindEdges, ...more });

export const lineMaterial = (color, opacity) => new THREE.LineBasicMaterial({ color, transparent: true, opacity });

function geometryOf(points) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
  return geometry;
}

const triangulate = (flat) => THREE.ShapeUtils.triangulateShape(flat.map(([x, y]) => new THREE.Vector2(x, y)), []);

function faces(points, colorIndex, layer) {
  const geometry = geometryOf(points);
  geometry.computeVertexNormals();
  const polygonOffsetUnits = kBehindEdges.polygonOffsetUnits + kLayerUnits * layer;
  return new THREE.Mesh(geometry, faceMaterial(colorIndex, { side: THREE.DoubleSide, flatShading: true, polygonOffsetUnits }));
}

/**
 * The solid of an outline (lengths in `unit` mm) with edges in `edgeColor`. If faces of two solids
 * share a plane, the face of the lower layer is visible.
 */
export function solidOf(outline, unit, colorIndex, edgeColor, layer = 0) {
  const group = new THREE.Group();
  const all = strokes(outline, unit);
  const points = prisms(all).flatMap((prism) => triangles(prism, triangulate));
  const isBare = points.length === 0;
  if (!isBare) group.add(faces(points, colorIndex, layer));
  const ink = isBare ? lineMaterial(colorOf(colorIndex), 1) : lineMaterial(edgeColor, 0.75);
  group.add(new THREE.LineSegments(geometryOf(segments(all)), ink));
  return group;
}
