// glTF-Transform reads the instanced GLB: every stone is where the table says.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {NodeIO} from '@gltf-transform/core';
import {EXTMeshGPUInstancing, KHRMeshQuantization} from '@gltf-transform/extensions';

const folder = process.argv[2];
const stones = JSON.parse(fs.readFileSync(path.join(folder, 'stones.json')));
const document = await new NodeIO().registerExtensions([EXTMeshGPUInstancing, KHRMeshQuantization])
    .read(path.join(folder, 'gpu.glb'));

const root = document.getRoot().listNodes().find((node) => node.getName() === 'stones');
const origin = root.getTranslation();
const close = (a, b, what) => assert(Math.abs(a - b) < 1e-4, `${what}: ${a} is not ${b}`);
let count = 0;
for (const node of root.listChildren()) {
  const prototype = Number(node.getName().split('/')[1]);
  const instancing = node.getExtension('EXT_mesh_gpu_instancing');
  const [t, r, s] = ['TRANSLATION', 'ROTATION', 'SCALE'].map((a) => instancing.getAttribute(a));
  const triangles = node.getMesh().listPrimitives()[0].getIndices().getCount() / 3;
  for (let i = 0; i < t.getCount(); ++i, ++count) {
    const stone = stones[count];
    assert.equal(stone.prototype, prototype);
    assert.equal(stone.triangles, triangles);
    const [x, y, z] = stone.position;
    const position = t.getElement(i, []).map((value, axis) => value + origin[axis]);
    [x, z, -y].forEach((value, axis) => close(position[axis], value, `stone ${count}`));
    const [qx, qy, qz, qw] = stone.rotation;
    const rotation = r.getElement(i, []);
    const dot = rotation[0] * qx + rotation[1] * qz - rotation[2] * qy + rotation[3] * qw;
    close(Math.abs(dot), 1, `turn of stone ${count}`);
    s.getElement(i, []).forEach((value) => close(value, stone.scale, `size of stone ${count}`));
  }
}
assert.equal(count, stones.length);
console.log(`${count} stones where they should be`);
