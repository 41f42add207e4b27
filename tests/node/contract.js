// The contract as a judge: whether an answer is one that the contract allows.
'use strict';

const assert = require('node:assert/strict');
const Ajv2020 = require('ajv/dist/2020');
const addFormats = require('ajv-formats');

class Contract {
    constructor(document) {
        this.document = document;
        this.ajv = new Ajv2020({ strict: false, allErrors: true });
        addFormats(this.ajv);
        this.ajv.addSchema({ ...closed(document), $id: 'contract' });
        this.answered = new Set(); // "post /v1/optimize 200"
    }

    // [{ path, method, operation }]
    operations() {
        return Object.entries(this.document.paths).flatMap(([path, item]) =>
            Object.entries(item)
                .filter(([key]) => key !== 'parameters')
                .map(([method, operation]) => ({ path, method, operation })));
    }

    // Fails unless the answer's status, type, body and headers are as the operation says. Returns the body: parsed where it is
    // JSON, bytes otherwise.
    check(method, path, answer) {
        const place = `${method} ${path} ${answer.status}`;
        const responses = this.document.paths[path][method].responses;
        const key = responses[answer.status] ? String(answer.status) : 'default';
        assert.ok(responses[key], `${place} is not in the contract: ${answer.body.subarray(0, 300)}`);
        this.answered.add(place);
        const [response, pointer] = this.resolve(responses[key], `/paths/${escape(path)}/${method}/responses/${key}`);
        this.checkHeaders(response, pointer, answer, place);
        return this.checkBody(response, pointer, answer, place);
    }

    checkBody(response, pointer, answer, place) {
        if (!response.content) {
            assert.equal(answer.body.length, 0, `${place} has a body`);
            return undefined;
        }
        const type = (answer.headers['content-type'] || '').split(';')[0];
        assert.ok(response.content[type], `${place} is ${type}; the contract has ${Object.keys(response.content)}`);
        if (!/json$/.test(type) || type === 'model/gltf+json') return answer.body;
        const body = JSON.parse(answer.body);
        if (response.content[type].schema) {
            this.validate(`${pointer}/content/${escape(type)}/schema`, body, place);
        }
        return body;
    }

    // Headers of ours that the contract does not have are mistakes; those that it has are valid where they are there.
    checkHeaders(response, pointer, answer, place) {
        const known = new Map(Object.entries(response.headers || {}).map(([name, value]) => [name.toLowerCase(), [name, value]]));
        for (const [name, text] of Object.entries(answer.headers)) {
            if (!known.has(name)) {
                assert.ok(!name.startsWith('coppice-'), `${place} has ${name}, which is not in the contract`);
                continue;
            }
            const [written, value] = known.get(name);
            const [header, at] = this.resolve(value, `${pointer}/headers/${escape(written)}`);
            this.validate(`${at}/schema`, header.schema.type === 'integer' ? Number(text) : text, `${place} ${name}`);
        }
    }

    validate(pointer, value, place) {
        const validate = this.ajv.compile({ $ref: `contract#${pointer}` });
        assert.ok(validate(value), `${place}: ${this.ajv.errorsText(validate.errors)}\n${JSON.stringify(value).slice(0, 2000)}`);
    }

    // Follows a $ref: [what it refers to, where that is].
    resolve(value, pointer) {
        if (!value.$ref) return [value, pointer];
        const target = value.$ref.slice(1);
        const keys = target.slice(1).split('/').map((key) => key.replace(/~1/g, '/').replace(/~0/g, '~'));
        return [keys.reduce((object, key) => object[key], this.document), target];
    }
}

function escape(key) {
    return encodeURIComponent(key.replace(/~/g, '~0').replace(/\//g, '~1'));
}

// The same document, where an object with properties has no others: clients must take what they do not know, but what
// the service answers today is all written down.
function closed(value) {
    if (Array.isArray(value)) return value.map(closed);
    if (value === null || typeof value !== 'object') return value;
    const copy = Object.fromEntries(Object.entries(value).map(([key, item]) => [key, closed(item)]));
    const is_schema = copy.properties && typeof copy.type !== 'object' || Array.isArray(copy.type) && copy.properties;
    if (is_schema && copy.additionalProperties === undefined) copy.additionalProperties = false;
    return copy;
}

module.exports = { Contract };
