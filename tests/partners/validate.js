// The Khronos validator finds neither error nor warning in any GLB of the folder.
import fs from 'node:fs';
import path from 'node:path';
import {validateBytes} from 'gltf-validator';

const folder = process.argv[2];
const files = fs.readdirSync(folder).filter((name) => name.endsWith('.glb'));
if (files.length === 0) throw new Error(`no GLB in ${folder}`);

let faults = 0;
for (const name of files) {
  const report = await validateBytes(new Uint8Array(fs.readFileSync(path.join(folder, name))));
  const {numErrors, numWarnings, numInfos, messages} = report.issues;
  console.log(`${name}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes`);
  for (const message of messages.slice(0, 8))
    console.log(`  ${message.code} ${message.pointer ?? ''}: ${message.message}`);
  faults += numErrors + numWarnings;
}
process.exit(faults === 0 ? 0 : 1);
