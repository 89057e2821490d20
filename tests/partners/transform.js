// glTF-Transform reads the instanced GLBs: every stone is where the table says.
import path from 'node:path';
import {MathUtils, NodeIO} from '@gltf-transform/core';
import {EXTMeshGPUInstancing, KHRMeshQuantization, KHRTextureTransform} from
    '@gltf-transform/extensions';
import {compare, files} from './stones.js';

function reachOf(mesh) {
  const positions = mesh.listPrimitives()[0].getAttribute('POSITION');
  let reach = 0;
  for (let i = 0; i < positions.getCount(); ++i)
    reach = Math.max(reach, Math.hypot(...positions.getElement(i, [])));
  return reach;
}

function transformed(m, [x, y, z]) {
  return [0, 1, 2].map((k) => m[k] * x + m[k + 4] * y + m[k + 8] * z + m[k + 12]);
}

// The instances of a node: what the node does to all of them, and the attributes to each.
function stonesOf(node) {
  const world = node.getWorldMatrix();
  const instancing = node.getExtension('EXT_mesh_gpu_instancing');
  const [t, r, s] = ['TRANSLATION', 'ROTATION', 'SCALE'].map((a) => instancing.getAttribute(a));
  const triangles = node.getMesh().listPrimitives()[0].getIndices().getCount() / 3;
  const reach = reachOf(node.getMesh());
  const position = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1];
  MathUtils.decompose(world, position, rotation, scale);
  return Array.from({length: t.getCount()}, (_, i) => ({
    position: transformed(world, t.getElement(i, [])),
    // Turned by the node or by the attribute, never by both.
    rotation: r ? r.getElement(i, []) : rotation,
    triangles,
    reach: reach * scale[0] * (s ? s.getElement(i, [])[0] : 1),
  }));
}

const folder = process.argv[2];
const io = new NodeIO().registerExtensions(
    [EXTMeshGPUInstancing, KHRMeshQuantization, KHRTextureTransform]);
for (const [file, table] of files) {
  const root = (await io.read(path.join(folder, file))).getRoot();
  const found = root.listNodes().filter((node) => node.getMesh()).flatMap(stonesOf);
  compare(folder, table, found);
  console.log(`${file}: ${found.length} stones where they should be`);
}
