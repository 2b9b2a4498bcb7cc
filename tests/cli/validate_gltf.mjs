// Validates a glTF asset with Khronos' validator: node validate_gltf.mjs PACKAGE FILE, PACKAGE being the folder of npm's
// gltf-validator. Prints what is wrong, hints included, and what the images are; exits with 1 if anything is wrong.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';

const [, , folder, file] = process.argv;
const { validateBytes } = createRequire(import.meta.url)(resolve(folder));
const { issues, info } = await validateBytes(new Uint8Array(readFileSync(file)), {
  uri: file,
  externalResourceFunction: async (uri) => new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
});
for (const { code, message, pointer } of issues.messages) console.log(`${code} ${pointer}: ${message}`);
for (const { uri, image } of info.resources ?? []) console.log(`${uri} ${image?.width} x ${image?.height} ${image?.format}`);
process.exit(issues.messages.length > 0 ? 1 : 0);
