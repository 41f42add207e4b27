// Holds routes and contract against each other, and validates real answers: node contract_test.js COPPICE
'use strict';

const assert = require('node:assert/strict');
const path = require('node:path');
const { before, after, test } = require('node:test');

const { Contract } = require('./contract');
const { multipart, sample, send, startService } = require('./service');

const coppice = path.resolve(process.argv[2]);
const unknown_job = '0'.repeat(32);
const glb = { 'Content-Type': 'model/gltf-binary' };

let service;
let contract;
let scene;

before(async () => {
    scene = sample(coppice, 'forest', 'glb', ['--scale', '0.2']);
    service = await startService(coppice);
    const answer = await send(service, 'GET', '/openapi.json');
    assert.equal(answer.status, 200);
    contract = new Contract(JSON.parse(answer.body));
    contract.check('get', '/openapi.json', answer);
});

after(async () => {
    if (service) assert.equal(await service.stop(), 0, service.log());
});

// Sends, checks the answer against the contract and the status, and returns { answer, body }.
async function ask(method, path, status, { id = unknown_job, query = '', ...request } = {}) {
    const answer = await send(service, method.toUpperCase(), path.replace('{id}', id) + query, request);
    assert.equal(answer.status, status, `${method} ${path}${query}: ${answer.body.subarray(0, 500)}`);
    return { answer, body: contract.check(method, path, answer) };
}

async function refused(method, path, status, code, request) {
    const { body } = await ask(method, path, status, request);
    assert.equal(body.code, code);
    assert.equal(body.status, status);
    assert.ok(body.detail.length > 10, `"${body.detail}" says too little`);
    return body;
}

async function finished(id) {
    for (let i = 0; i < 600; ++i) {
        const { body } = await ask('get', '/v1/jobs/{id}', 200, { id });
        if (!['queued', 'running'].includes(body.status)) return body;
        await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`job ${id} does not finish`);
}

const id_of = (answer) => answer.headers.location.split('/').pop();

test('every operation of the contract has a route', async () => {
    for (const { path, method } of contract.operations()) {
        const answer = await send(service, method.toUpperCase(), path.replace('{id}', unknown_job));
        const body = contract.check(method, path, answer);
        assert.notEqual(answer.status, 405, `${method} ${path}`);
        if (answer.status === 404) assert.equal(body.code, 'job.not_found', `${method} ${path}`);
    }
});

test('no path takes a method that the contract does not have, and Allow names those that it has', async () => {
    for (const [path, item] of Object.entries(contract.document.paths)) {
        const allowed = Object.keys(item).filter((key) => key !== 'parameters');
        for (const method of ['get', 'post', 'put', 'delete', 'patch']) {
            if (allowed.includes(method)) continue;
            const answer = await send(service, method.toUpperCase(), path.replace('{id}', unknown_job));
            assert.equal(answer.status, 405, `${method} ${path}`);
            contract.validate('/components/schemas/Problem', JSON.parse(answer.body), `${method} ${path}`);
            const told = answer.headers.allow.toLowerCase().split(/, */).filter((name) => name !== 'head' && name !== 'options');
            assert.deepEqual(told.sort(), [...allowed].sort(), `Allow of ${path}`);
        }
    }
});

test('an asset comes back with the headers of the contract', async () => {
    const { answer } = await ask('post', '/v1/optimize', 200, { query: '?ratio=0.5', headers: glb, body: scene });
    assert.equal(answer.body.subarray(0, 4).toString(), 'glTF');
    const told = Object.keys(contract.document.paths['/v1/optimize'].post.responses['200'].headers);
    for (const name of told.filter((header) => header !== 'Preference-Applied')) {
        assert.ok(answer.headers[name.toLowerCase()], `${name} is missing`);
    }
    assert.equal(Number(answer.headers['coppice-input-bytes']), scene.length);
    assert.equal(Number(answer.headers['coppice-output-bytes']), answer.body.length);
    const [before_count, after_count] = answer.headers['coppice-triangles'].split(';').map(Number);
    assert.ok(after_count <= before_count * 0.52, answer.headers['coppice-triangles']);
});

test('every format that is written is an answer of the contract', async () => {
    for (const format of contract.document.components.schemas.Options.properties.format.enum) {
        const instancing = format === 'obj' ? '&instancing=expand' : '';
        await ask('post', '/v1/optimize', 200, { query: `?format=${format}${instancing}`, headers: glb, body: scene });
    }
});

test('a form carries the asset, its resources and the options', async () => {
    const form = multipart([
        { name: 'asset', filename: 'forest.glb', type: 'model/gltf-binary', bytes: scene },
        { name: 'options', type: 'application/json', bytes: '{"ratio":0.5,"parameters":{"mode":"full"}}' },
    ]);
    const { answer } = await ask('post', '/v1/optimize', 200, form);
    const job = await finished(id_of(answer));
    assert.equal(job.options.ratio, 0.5);
});

test('a job is acknowledged, listed, finished, fetched in parts, and deleted', async () => {
    const { answer, body } = await ask('post', '/v1/jobs', 202, { query: '?ratio=0.4', headers: glb, body: scene });
    const id = id_of(answer);
    assert.equal(body.id, id);
    const job = await finished(id);
    assert.equal(job.status, 'succeeded');
    assert.equal(job.report.output.instances, job.report.input.instances);

    const { body: list } = await ask('get', '/v1/jobs', 200, { query: '?status=succeeded&limit=2' });
    assert.equal(list.jobs[0].id, id);
    assert.equal(list.jobs.length, 2);
    const { body: next } = await ask('get', '/v1/jobs', 200, { query: `?limit=1&cursor=${encodeURIComponent(list.next_cursor)}` });
    assert.notEqual(next.jobs[0].id, id);

    const { answer: whole } = await ask('get', '/v1/jobs/{id}/result', 200, { id });
    const { answer: part } = await ask('get', '/v1/jobs/{id}/result', 206, { id, headers: { Range: 'bytes=4-11' } });
    assert.deepEqual(part.body, whole.body.subarray(4, 12));
    await ask('get', '/v1/jobs/{id}/result', 304, { id, headers: { 'If-None-Match': whole.headers.etag } });
    await refused('get', '/v1/jobs/{id}/result', 416, 'range.not_satisfiable', { id, headers: { Range: 'bytes=99999999-' } });
    await ask('get', '/v1/jobs/{id}/report', 200, { id });
    await refused('post', '/v1/jobs/{id}/cancel', 409, 'job.finished', { id });

    await ask('delete', '/v1/jobs/{id}', 204, { id });
    await refused('get', '/v1/jobs/{id}', 410, 'job.deleted', { id });
    await refused('get', '/v1/jobs/{id}/result', 410, 'job.deleted', { id });
});

test('whoever does not want to wait gets the job, and the result later', async () => {
    const headers = { ...glb, Prefer: 'respond-async' };
    const { answer } = await ask('post', '/v1/optimize', 202, { query: '?ratio=0.3', headers, body: scene });
    assert.equal(answer.headers['preference-applied'], 'respond-async');
    assert.equal((await finished(id_of(answer))).status, 'succeeded');
});

test('a job that runs or waits can be cancelled, and says so', async () => {
    const headers = { ...glb, Prefer: 'respond-async' };
    const large = sample(coppice, 'forest', 'glb', ['--scale', '3']);
    const { answer } = await ask('post', '/v1/optimize', 202, { query: '?ratio=0.01', headers, body: large });
    const id = id_of(answer);
    await ask('post', '/v1/jobs/{id}/cancel', 202, { id });
    const job = await finished(id);
    assert.equal(job.status, 'cancelled');
    assert.equal(job.problem.code, 'job.cancelled');
    await refused('get', '/v1/jobs/{id}/result', 409, 'job.cancelled', { id });
});

test('an inspection tells what is in an asset', async () => {
    const { body, answer } = await ask('post', '/v1/inspect', 200, { headers: glb, body: scene });
    assert.ok(body.summary.instances > body.summary.meshes);
    const { body: report } = await ask('get', '/v1/jobs/{id}/report', 200, { id: id_of(answer) });
    assert.deepEqual(report, body);
    await ask('get', '/v1/jobs/{id}/result', 200, { id: id_of(answer) });
    assert.equal((await finished(id_of(answer))).kind, 'inspect');
    await ask('post', '/v1/inspect', 202, { headers: { ...glb, Prefer: 'respond-async' }, body: scene });
});

test('a comparison tells how far one asset is from another', async () => {
    const { body: small } = await ask('post', '/v1/optimize', 200, { headers: glb, body: scene });
    const form = (...parts) => multipart([{ name: 'reference', filename: 'a.glb', bytes: scene }, ...parts]);
    const both = form(
        { name: 'candidate', filename: 'b.glb', bytes: small },
        { name: 'options', bytes: '{"self_intersections":true}' },
    );
    const { body, answer } = await ask('post', '/v1/compare', 200, both);
    assert.equal(body.measured, 'meshes');
    assert.equal(body.surface.flipped_triangles, 0);
    assert.ok(body.surface.surface_distance.symmetric.largest_diagonal_fraction < 0.05);
    const { body: same } = await ask(
        'post', '/v1/compare', 200, form({ name: 'candidate', filename: 'b.glb', bytes: scene }),
    );
    assert.equal(same.surface.flipped_triangles, 0);
    assert.ok(same.surface.surface_distance.symmetric.largest_diagonal_fraction < 1e-9);
    assert.equal(body.meshes.length, body.reference.meshes);
    const { body: report } = await ask('get', '/v1/jobs/{id}/report', 200, { id: id_of(answer) });
    assert.deepEqual(report, body);
    await ask('get', '/v1/jobs/{id}/result', 200, { id: id_of(answer) });
    assert.equal((await finished(id_of(answer))).kind, 'compare');
    await ask('post', '/v1/compare', 202, { ...both, headers: { ...both.headers, Prefer: 'respond-async' } });
    await refused('post', '/v1/compare', 400, 'request.malformed', form());
    await refused('post', '/v1/compare', 415, 'request.type_unsupported', { headers: glb, body: scene });
});

test('the service tells its algorithms, its health and its figures', async () => {
    const { body } = await ask('get', '/v1/algorithms', 200);
    assert.ok(body.algorithms.some((algorithm) => algorithm.id === body.default_algorithm));
    await ask('get', '/healthz', 200);
    await ask('get', '/readyz', 200);
    const { body: figures } = await ask('get', '/metrics', 200);
    assert.match(figures.toString(), /^# TYPE coppice_/m);
});

test('bad options are problems that name the option', async () => {
    const bad = [
        ['?ratio=0', 'option.invalid', 'ratio'],
        ['?ratio=1.5', 'option.invalid', 'ratio'],
        ['?ratio=abc', 'option.invalid', 'ratio'],
        ['?rato=0.5', 'option.unknown', 'rato'],
        ['?compression=draco', 'option.unknown', 'compression'],
        ['?ratio=0.5&triangles=10', 'option.conflict', 'triangles'],
        ['?ratio=0.5&ratio=0.6', 'option.conflict', 'ratio'],
        ['?format=obj&instancing=nodes', 'option.conflict', 'instancing'],
        ['?instancing=gpu', 'option.invalid', 'instancing'],
        ['?parameters.threshold=3', 'option.conflict', 'parameters.threshold'],
        ['?algorithm=qslim', 'option.invalid', 'algorithm'],
        ['?parameters.mode=half', 'option.invalid', 'parameters.mode'],
    ];
    for (const [query, code, where] of bad) {
        for (const path of ['/v1/optimize', '/v1/jobs']) {
            const body = await refused('post', path, 400, code, { query, headers: glb, body: scene });
            assert.equal(body.where, where, query);
        }
    }
    await refused('get', '/v1/jobs', 400, 'option.invalid', { query: '?status=done' });
    await refused('get', '/v1/jobs', 400, 'option.invalid', { query: '?limit=0' });
});

test('bad assets are problems that say what and where', async () => {
    await refused('post', '/v1/optimize', 400, 'asset.empty', { headers: glb, body: '' });
    await refused('post', '/v1/optimize', 415, 'asset.unsupported', { body: 'no asset at all' });
    const { body, answer } = await ask('post', '/v1/optimize', 422, { headers: glb, body: scene.subarray(0, scene.length - 8) });
    assert.equal(body.code, 'asset.malformed');
    const job = await finished(id_of(answer));
    assert.equal(job.status, 'failed');
    assert.equal(job.problem.code, 'asset.malformed');
    await refused('get', '/v1/jobs/{id}/result', 409, 'asset.malformed', { id: job.id });
});

test('a path that does not exist is a problem too', async () => {
    const answer = await send(service, 'GET', '/v1/nothing');
    assert.equal(answer.status, 404);
    const body = JSON.parse(answer.body);
    contract.validate('/components/schemas/Problem', body, '/v1/nothing');
    assert.equal(body.code, 'route.not_found');
});

test('every operation was seen to succeed', () => {
    for (const { path, method, operation } of contract.operations()) {
        for (const status of Object.keys(operation.responses).filter((key) => key.startsWith('2'))) {
            assert.ok(contract.answered.has(`${method} ${path} ${status}`), `${method} ${path} never answered ${status}`);
        }
    }
});
