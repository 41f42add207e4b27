// Runs Khronos' validator on glTF files and fails if any has an error.
//
//   node validate_gltf.js [--json] FILE...
//
// --json prints one line per file: {file, errors, warnings, messages}. Extensions that the validator does not know
// (EXT_mesh_gpu_instancing, KHR_draco_mesh_compression, EXT_meshopt_compression) are not errors to it, and unchecked.
'use strict';

const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function validate(file) {
    const folder = path.dirname(file);
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        maxIssues: 0,
        externalResourceFunction: async (uri) => new Uint8Array(fs.readFileSync(path.join(folder, decodeURIComponent(uri)))),
    });
    const { numErrors, numWarnings, messages } = report.issues;
    return { file, errors: numErrors, warnings: numWarnings, messages };
}

async function main(files, json) {
    if (files.length === 0) throw new Error('usage: validate_gltf.js [--json] FILE...');
    let failed = 0;
    for (const file of files) {
        const result = await validate(file).catch((error) => ({
            file, errors: 1, warnings: 0, messages: [{ severity: 0, code: 'UNREADABLE', message: String(error) }],
        }));
        if (result.errors > 0) failed++;
        if (json) {
            console.log(JSON.stringify(result));
            continue;
        }
        console.log(`${file}: ${result.errors} errors, ${result.warnings} warnings`);
        for (const { severity, code, message, pointer } of result.messages.slice(0, 20)) {
            if (severity === 0) console.log(`  ${code} ${pointer ?? ''} ${message}`);
        }
    }
    return failed > 0 ? 1 : 0;
}

const arguments_ = process.argv.slice(2);
main(arguments_.filter((argument) => argument !== '--json'), arguments_.includes('--json'))
    .then((code) => { process.exitCode = code; }, (error) => { console.error(error.message); process.exitCode = 2; });
