// TinyUSDZ parses the USD text: every part is there, every stone where the table says; what is cut
// off is refused.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

// It is made for browsers only; what it asks them for is a file and a worker's name.
process.type = 'renderer';
globalThis.self = globalThis;
globalThis.WorkerGlobalScope = class {};
const {default: TinyUSDZ} = await import('tinyusdz');
const wasm = new URL('tinyusdz.wasm', import.meta.resolve('tinyusdz'));
const usd = await TinyUSDZ({wasmBinary: fs.readFileSync(fileURLToPath(wasm)), printErr() {}});

function parse(bytes) {
  const loader = new usd.TinyUSDZLoaderNative();
  return loader.loadAsLayerFromBinary(new Uint8Array(bytes), 'scene.usda') &&
      loader.layerToString();
}

// The numbers of an array in the text that the reader makes of what it understood.
function numbers(text, name) {
  const begin = text.indexOf(`${name} = [`) + name.length + 4;
  assert(begin >= name.length + 4, `no ${name}`);
  return text.slice(begin, text.indexOf(']', begin)).match(/-?\d[\d.e+-]*/g).map(Number);
}

const folder = process.argv[2];
const bytes = fs.readFileSync(path.join(folder, 'landscape.usda'));
const stones = JSON.parse(fs.readFileSync(path.join(folder, 'stones.json')));
const text = parse(bytes);
assert(text, 'it is no USD');

assert(text.includes('metersPerUnit = 1'));
assert(text.includes('upAxis = "Z"'));
for (const prim of ['Xform "scene"', 'Mesh "ground"', 'Mesh "water"', 'PointInstancer "stones"'])
  assert.equal(text.split(`def ${prim}`).length, 2, prim);

const prototypes = new Set(stones.map((stone) => stone.prototype));
const instancer = text.slice(text.indexOf('def PointInstancer "stones"'));
assert.equal(instancer.split('def Mesh "stone_').length - 1, prototypes.size);
for (const prototype of prototypes) {
  const mesh = instancer.slice(instancer.indexOf(`def Mesh "stone_${prototype}"`));
  const {triangles} = stones.find((stone) => stone.prototype === prototype);
  assert.equal(numbers(mesh, 'int[] faceVertexCounts').length, triangles);
  assert.equal(numbers(mesh, 'int[] faceVertexIndices').length, 3 * triangles);
}

const translate = instancer.match(/xformOp:translate = \((.*?)\)/)[1].split(',').map(Number);
const positions = numbers(instancer, 'point3f[] positions');
const turns = numbers(instancer, 'quath[] orientations');
const scales = numbers(instancer, 'float3[] scales');
const indices = numbers(instancer, 'int[] protoIndices');
assert.equal(positions.length, 3 * stones.length);
stones.forEach((stone, i) => {
  assert.equal(indices[i], stone.prototype);
  const miss = [0, 1, 2].map((k) => positions[3 * i + k] + translate[k] - stone.position[k]);
  assert(Math.hypot(...miss) < 1e-4, `stone ${i} is off by ${miss}`);
  assert(Math.abs(scales[3 * i] - stone.scale) < 1e-5, `stone ${i} has another size`);
  const [x, y, z, w] = stone.rotation;
  const turn = Math.hypot(...[w, x, y, z].map((value, k) => value - turns[4 * i + k]));
  assert(turn < 1e-3, `stone ${i} is turned by ${turn}`);
});
for (const part of [0.1, 0.5, 0.9])
  assert(!parse(bytes.subarray(0, Math.floor(part * bytes.length))), `cut to ${part} it is read`);
console.log(`${stones.length} stones of ${prototypes.size} meshes where they should be`);
