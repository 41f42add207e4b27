// Runs the curl sessions of a document against a real service, and compares what comes out with what the document shows.
//
//   node session_test.js [--print] COPPICE DOCUMENT
//
// --print prints what the blocks print, to bring the document up to date. A document that uses $ASSETS is skipped where
// the test assets are not there.
//
// Blocks marked `sh` that call curl run in order, in one shell and one folder, exactly as a reader would paste them,
// except that the service has a port of its own. A block marked `text` right after one is what it prints: ids, hashes,
// dates and times may differ, and numbers by 3 %, since other compilers round otherwise.
'use strict';

const assert = require('node:assert/strict');
const { execFile } = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const { startService } = require('./service');

const prints = process.argv[2] === '--print';
const [coppice, document] = process.argv.slice(prints ? 3 : 2).map((file) => path.resolve(file));
const assets = process.env.COPPICE_TEST_ASSETS || path.resolve(__dirname, '../../../shared/assets');
const skipped = 77;
const marker = '-- end of block --';

// [{ line, script, output? }]
function sessions(markdown) {
    const blocks = [];
    const fence = /^```(\w*)\n([\s\S]*?)^```$/gm;
    for (let found; (found = fence.exec(markdown)); ) {
        const [, kind, text] = found;
        const last = blocks[blocks.length - 1];
        if (kind === 'sh' && /\bcurl\b/.test(text)) {
            const line = markdown.slice(0, found.index).split('\n').length;
            blocks.push({ line, script: text, end: fence.lastIndex });
        } else if (kind === 'text' && last && markdown.slice(last.end, found.index).trim() === '') {
            last.output = text;
        }
    }
    return blocks;
}

function normalize(text) {
    return text
        .replace(/\r/g, '')
        .replace(/[0-9a-f]{64}/g, 'HASH')
        .replace(/[0-9a-f]{32}/g, 'ID')
        .replace(/\d{4}-\d\d-\d\dT[\d:.]+Z/g, 'TIME')
        .replace(/(date|x-request-id): .*/gi, '$1: ...')
        .replace(/dur=[\d.]+/g, 'dur=T')
        .replace(/, queue;dur=T/g, '') // only told where it took any time
        .replace(/(127\.0\.0\.1|localhost):\d+/g, 'SERVICE')
        .replace(/[\d.]+ ms/g, 'T ms')
        .trim();
}

const number = /\d+(?:\.\d+)?/g;

function is_like(shown, real) {
    if (shown === real) return true;
    if (shown.replace(number, '#') !== real.replace(number, '#')) return false;
    const [some, others] = [shown.match(number), real.match(number)].map((list) => list.map(Number));
    return some.every((value, i) => Math.abs(value - others[i]) <= 0.03 * Math.abs(value));
}

function run(script, folder) {
    const options = { cwd: folder, timeout: 240_000, maxBuffer: 64 << 20, env: { ...process.env, ASSETS: assets } };
    return new Promise((resolve) => {
        execFile('bash', ['-c', script], options, (error, stdout, stderr) =>
            resolve({ code: error ? error.code : 0, stdout, stderr }));
    });
}

async function main() {
    const markdown = fs.readFileSync(document, 'utf8');
    if (markdown.includes('$ASSETS') && !fs.existsSync(assets)) {
        console.log(`skipped: ${assets} is not there`);
        process.exitCode = skipped;
        return;
    }
    const blocks = sessions(markdown);
    assert.ok(blocks.length > 0, `${document} has no curl session`);
    const service = await startService(coppice);
    try {
        fs.mkdirSync(path.join(service.work, 'build', 'release'), { recursive: true });
        fs.symlinkSync(coppice, path.join(service.work, 'build', 'release', 'coppice'));
        const script = blocks.map((block) => `${block.script}\necho '${marker}'`).join('\n');
        const here = script.replaceAll('localhost:8080', `127.0.0.1:${service.port}`);
        const { code, stdout, stderr } = await run(`set -euo pipefail\n${here}`, service.work);
        const outputs = stdout.split(`${marker}\n`);
        const reached = blocks[Math.min(outputs.length, blocks.length) - 1];
        assert.equal(code, 0, `the block at line ${reached.line} leaves ${code}:\n${outputs.at(-1)}\n${stderr.slice(0, 4000)}\n${service.log().slice(-4000)}`);
        if (prints) {
            outputs.forEach((output) => console.log(`${output}--------`));
            return;
        }
        blocks.forEach((block, i) => compare(block, outputs[i]));
        console.log(`${blocks.length} blocks ran as shown`);
    } finally {
        await service.stop();
    }
}

function compare(block, output) {
    if (block.output === undefined) return;
    const [shown, real] = [normalize(block.output).split('\n'), normalize(output).split('\n')];
    const same = shown.length === real.length && shown.every((line, i) => is_like(line, real[i]));
    assert.ok(same, `the block at line ${block.line} shows\n\n${shown.join('\n')}\n\nand prints\n\n${real.join('\n')}`);
}

main().catch((error) => {
    console.error(error.message);
    process.exitCode = 1;
});
