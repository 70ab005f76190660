// Colours of the scene in the light and the dark theme, and its light sources.
import * as THREE from "three";

export const themes = {
  light: { background: 0xeef1f4, floor: 0xdfe4e9, line: 0xb9c2cb, edge: 0x2b3138, accent: 0xd9622b, alarm: 0xc62f26 },
  dark: { background: 0x11161c, floor: 0x1a2129, line: 0x303a45, edge: 0x05080b, accent: 0xff8a3d, alarm: 0xff6f63 },
};

function directed(color, intensity, position) {
  const light = new THREE.DirectionalLight(color, intensity);
  light.position.set(...position);
  return light;
}

export const lamps = () => [
  new THREE.HemisphereLight(0xffffff, 0x8a949e, 1.6),
  directed(0xffffff, 1.9, [900, -700, 1600]),
  directed(0xcfe0ff, 0.5, [-800, 900, 500]),
];
