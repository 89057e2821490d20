// What the readers of instanced files are compared with.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';

const radians = 1e-3, metres = 1e-4;

// Files and the tables of where their stones are.
export const files = [['gpu.glb', 'stones.json'], ['pile.glb', 'pile.json']];

const chord = (p, q) => Math.hypot(...p.map((value, i) => value - q[i]));

// `found` has a position, a unit quaternion (x, y, z, w), the triangles and the reach of every
// stone, all in glTF's axes and metres. No two stones are at one x.
export function compare(folder, table, found) {
  const stones = JSON.parse(fs.readFileSync(path.join(folder, table)));
  assert.equal(found.length, stones.length);
  stones.sort((a, b) => a.position[0] - b.position[0]);
  found.sort((a, b) => a.position[0] - b.position[0]);
  stones.forEach((stone, i) => {
    const {position, rotation, triangles, reach} = found[i];
    const [x, y, z] = stone.position;
    const distance = Math.hypot(position[0] - x, position[1] - z, position[2] + y);
    assert(distance < metres, `stone ${i} is off by ${distance}`);
    const [qx, qy, qz, qw] = stone.rotation;
    const turn = [qx, qz, -qy, qw], other = turn.map((value) => -value);
    const angle = 2 * Math.min(chord(rotation, turn), chord(rotation, other));
    assert(angle < radians, `stone ${i} is turned by ${angle}`);
    assert.equal(triangles, stone.triangles);
    const size = stone.scale * stone.reach;
    assert(Math.abs(reach - size) < metres, `stone ${i} reaches ${reach}, not ${size}`);
  });
}
