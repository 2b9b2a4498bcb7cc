// Validates WGSL with Dawn's compiler, on no device: node validate_wgsl.mjs PACKAGE FILE, PACKAGE being the folder of
// npm's webgpu. Prints what is wrong; exits with 1 if anything is.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [, , folder, file] = process.argv;
const { create } = await import(pathToFileURL(`${folder}/index.js`));
const adapter = await create(['backend=null']).requestAdapter();
const device = await adapter.requestDevice();
device.pushErrorScope('validation');
const module = device.createShaderModule({ code: readFileSync(file, 'utf8') });
const { messages } = await module.getCompilationInfo();
for (const { type, lineNum, linePos, message } of messages) console.log(`${type} ${lineNum}:${linePos} ${message}`);
const error = await device.popErrorScope();
process.exit(error || messages.length > 0 ? 1 : 0);
