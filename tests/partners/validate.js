// The Khronos validator finds neither error nor warning in any GLB of the folder.
import fs from 'node:fs';
import path from 'node:path';
import {validateBytes} from 'gltf-validator';

// Tangents are left to the reader, who makes them as MikkTSpace says.
const ignoredIssues = ['MESH_PRIMITIVE_GENERATED_TANGENT_SPACE'];

const folder = process.argv[2];
const files = fs.readdirSync(folder).filter((name) => name.endsWith('.glb'));
if (files.length === 0) throw new Error(`no GLB in ${folder}`);

let faults = 0;
for (const name of files) {
  const report = await validateBytes(
      new Uint8Array(fs.readFileSync(path.join(folder, name))), {ignoredIssues});
  const {numErrors, numWarnings, numInfos, messages} = report.issues;
  console.log(`${name}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes`);
  for (const message of messages.slice(0, 8))
    console.log(`  ${message.code} ${message.pointer ?? ''}: ${message.message}`);
  faults += numErrors + numWarnings;
}
process.exit(faults === 0 ? 0 : 1);
