// A real service for a test: the built binary, on a port of its own, with a data directory that goes away.
'use strict';

const { spawn, execFileSync } = require('node:child_process');
const fs = require('node:fs');
const http = require('node:http');
const os = require('node:os');
const path = require('node:path');

// Resolves to { port, url, work, stop() } once the service says where it listens.
async function startService(coppice, flags = []) {
    const work = fs.mkdtempSync(path.join(os.tmpdir(), 'coppice-test-'));
    const child = spawn(coppice, ['serve', '--listen', '127.0.0.1:0', '--data', path.join(work, 'data'), ...flags], {
        cwd: work,
        stdio: ['ignore', 'pipe', 'pipe'],
    });
    let log = '';
    const exited = new Promise((resolve) => child.on('exit', resolve));
    const port = await new Promise((resolve, reject) => {
        const late = setTimeout(() => reject(new Error(`the service did not start in 20 s:\n${log}`)), 20_000);
        const read = (chunk) => {
            log += chunk;
            const found = /"event":"listening".*"port":(\d+)/.exec(log);
            if (!found) return;
            clearTimeout(late);
            resolve(Number(found[1]));
        };
        child.stdout.on('data', read);
        child.stderr.on('data', read);
        exited.then((code) => reject(new Error(`the service left with ${code}:\n${log}`)));
    });
    const stop = async () => {
        child.kill('SIGTERM');
        const killer = setTimeout(() => child.kill('SIGKILL'), 15_000);
        const code = await exited;
        clearTimeout(killer);
        fs.rmSync(work, { recursive: true, force: true });
        return code;
    };
    return { port, url: `http://127.0.0.1:${port}`, work, stop, log: () => log };
}

// One request; { status, headers, body } with the body as bytes.
function send(service, method, target, { headers = {}, body } = {}) {
    return new Promise((resolve, reject) => {
        const length = body === undefined ? {} : { 'Content-Length': Buffer.byteLength(body) };
        const options = { port: service.port, host: '127.0.0.1', method, path: target, agent: false };
        const request = http.request({ ...options, headers: { ...length, ...headers } }, (response) => {
            const chunks = [];
            response.on('data', (chunk) => chunks.push(chunk));
            response.on('end', () =>
                resolve({ status: response.statusCode, headers: response.headers, body: Buffer.concat(chunks) }));
            response.on('error', reject);
        });
        request.on('error', reject);
        request.setTimeout(60_000, () => request.destroy(new Error(`${method} ${target}: no answer in 60 s`)));
        request.end(body);
    });
}

// The bytes of a procedural scene.
function sample(coppice, name, extension = 'glb', flags = []) {
    const file = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'coppice-sample-')), `${name}.${extension}`);
    try {
        execFileSync(coppice, ['sample', name, '-o', file, ...flags], { stdio: ['ignore', 'ignore', 'inherit'] });
        return fs.readFileSync(file);
    } finally {
        fs.rmSync(path.dirname(file), { recursive: true, force: true });
    }
}

// multipart/form-data; parts are { name, filename?, type?, bytes }.
function multipart(parts) {
    const boundary = 'coppice-test-boundary';
    const pieces = parts.flatMap(({ name, filename, type, bytes }) => [
        Buffer.from(
            `--${boundary}\r\nContent-Disposition: form-data; name="${name}"` +
                (filename ? `; filename="${filename}"` : '') +
                (type ? `\r\nContent-Type: ${type}` : '') +
                '\r\n\r\n',
        ),
        Buffer.from(bytes),
        Buffer.from('\r\n'),
    ]);
    return {
        headers: { 'Content-Type': `multipart/form-data; boundary=${boundary}` },
        body: Buffer.concat([...pieces, Buffer.from(`--${boundary}--\r\n`)]),
    };
}

module.exports = { startService, send, sample, multipart };
