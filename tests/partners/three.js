// three.js loads the instanced GLB as InstancedMeshes whose matrices put every stone in its place.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';

// Pictures need a browser; the loader only has to believe that they arrived.
globalThis.self = globalThis;
globalThis.createImageBitmap = async () => ({width: 1, height: 1, close() {}});
const {GLTFLoader} = await import('three/addons/loaders/GLTFLoader.js');
const {Matrix4, Quaternion, Vector3} = await import('three');

const folder = process.argv[2];
const stones = JSON.parse(fs.readFileSync(path.join(folder, 'stones.json')));
const bytes = fs.readFileSync(path.join(folder, 'gpu.glb'));
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const gltf = await new GLTFLoader().parseAsync(buffer, '');
gltf.scene.updateMatrixWorld(true);

const meshes = [];
gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
assert.equal(meshes.length, new Set(stones.map((stone) => stone.prototype)).size);
let count = 0;
for (const mesh of meshes) {
  assert(mesh.isInstancedMesh, `${mesh.name} is no InstancedMesh`);
  for (let i = 0; i < mesh.count; ++i, ++count) {
    const stone = stones[count];
    const matrix = new Matrix4();
    mesh.getMatrixAt(i, matrix);
    const position = new Vector3(), turn = new Quaternion(), scale = new Vector3();
    matrix.premultiply(mesh.matrixWorld).decompose(position, turn, scale);
    const [x, y, z] = stone.position;
    assert(position.distanceTo(new Vector3(x, z, -y)) < 1e-4, `stone ${count} is misplaced`);
    assert(Math.abs(scale.x - stone.scale) < 1e-5, `stone ${count} has another size`);
    const [qx, qy, qz, qw] = stone.rotation;
    assert(turn.angleTo(new Quaternion(qx, qz, -qy, qw)) < 1e-3, `stone ${count} is turned`);
  }
}
assert.equal(count, stones.length);
console.log(`${count} stones in ${meshes.length} InstancedMeshes where they should be`);
