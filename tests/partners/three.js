// three.js loads the instanced GLBs as InstancedMeshes whose matrices put every stone in its place.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {compare, files} from './stones.js';

// Pictures need a browser; the loader only has to believe that they arrived.
globalThis.self = globalThis;
globalThis.createImageBitmap = async () => ({width: 1, height: 1, close() {}});
const {GLTFLoader} = await import('three/addons/loaders/GLTFLoader.js');
const {Matrix4, Quaternion, Vector3} = await import('three');

function reachOf(geometry) {
  const positions = geometry.getAttribute('position'), p = new Vector3();
  let reach = 0;
  for (let i = 0; i < positions.count; ++i)
    reach = Math.max(reach, p.fromBufferAttribute(positions, i).length());
  return reach;
}

function stonesOf(mesh) {
  assert(mesh.isInstancedMesh, `${mesh.name} is no InstancedMesh`);
  const reach = reachOf(mesh.geometry);
  return Array.from({length: mesh.count}, (_, i) => {
    const matrix = new Matrix4();
    mesh.getMatrixAt(i, matrix);
    const position = new Vector3(), turn = new Quaternion(), scale = new Vector3();
    matrix.premultiply(mesh.matrixWorld).decompose(position, turn, scale);
    return {
      position: position.toArray(),
      rotation: turn.toArray(),
      triangles: mesh.geometry.index.count / 3,
      reach: reach * scale.x,
    };
  });
}

const folder = process.argv[2];
for (const [file, table] of files) {
  const bytes = fs.readFileSync(path.join(folder, file));
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const gltf = await new GLTFLoader().parseAsync(buffer, '');
  gltf.scene.updateMatrixWorld(true);
  const meshes = [];
  gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
  const found = meshes.flatMap(stonesOf);
  compare(folder, table, found);
  console.log(`${file}: ${found.length} stones in ${meshes.length} InstancedMeshes`);
}
