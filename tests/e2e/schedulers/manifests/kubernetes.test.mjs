// docker/kubernetes, rendered by kubectl, obeys Kubernetes' published schemas and fits the programs' flags.
// SWATH_PROGRAMS is the folder of the programs.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {fileURLToPath} from 'node:url';
import yaml from 'js-yaml';

import {reference_problems} from './references.mjs';
import {schema_problems} from './schema.mjs';

const folder = fileURLToPath(new URL('../../../../docker/kubernetes/', import.meta.url));
const run = (program, args) => execFileSync(program, args, {encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']});
const render = name => yaml.loadAll(run('kubectl', ['kustomize', path.join(folder, name)]));

const helps = new Map();
function help(program) {
    if (!helps.has(program)) {
        let text;
        try {
            text = run(path.join(process.env.SWATH_PROGRAMS, program), ['--help']);
        } catch { /* there is none */ }
        helps.set(program, text);
    }
    return helps.get(program);
}
function problems(documents) {
    const schema = schema_problems(documents);
    return schema.length > 0 ? schema : reference_problems(documents, help);
}

const layouts = ['base', 'overlays/local', 'overlays/large'];
const documents = new Map(layouts.map(name => [name, render(name)]));
const of = (name, kind, called) => documents.get(name).find(
    document => document.kind === kind && (!called || document.metadata.name === called));

for (const name of layouts)
    test(`${name} fits the schemas, itself and the programs`, () => assert.deepEqual(problems(documents.get(name)), []));

test('layouts are kubectl\'s to render without a warning', () => {
    for (const name of layouts) {
        const script = 'kubectl kustomize "$1" 2>&1 >/dev/null';
        assert.equal(run('sh', ['-c', script, 'sh', path.join(folder, name)]), '', name);
    }
});

test('every layout has the programs\' parts', () => {
    for (const name of layouts) {
        assert.ok(of(name, 'StatefulSet', 'swath-server'), name);
        for (const kind of ['Namespace', 'ConfigMap', 'PodDisruptionBudget', 'NetworkPolicy']) assert.ok(of(name, kind), kind);
        for (const called of ['swath-display', 'swath-client']) assert.ok(of(name, 'Deployment', called), called);
    }
});

test('the local layout is small and takes the image that was loaded', () => {
    assert.equal(of('overlays/local', 'StatefulSet').spec.replicas, 2);
    for (const {spec} of documents.get('overlays/local').filter(({kind}) => ['StatefulSet', 'Deployment'].includes(kind))) {
        const [container] = spec.template.spec.containers;
        assert.equal(container.imagePullPolicy, 'Never');
        assert.equal(container.resources.requests.cpu, '100m');
    }
});

test('the large layout has a server on each node and the model from a volume', () => {
    const server = of('overlays/large', 'StatefulSet').spec;
    assert.equal(server.replicas, 16);
    assert.ok(server.template.spec.affinity.podAntiAffinity.requiredDuringSchedulingIgnoredDuringExecution[0]);
    assert.deepEqual(server.template.spec.containers[0].resources.requests,
        server.template.spec.containers[0].resources.limits);
    assert.equal(of('overlays/large', 'ConfigMap').data.MODEL, '/models/model.ply');
    assert.equal(of('overlays/large', 'ConfigMap').data.ALGORITHM, 'hybrid');
});

test('the pod to copy models through fits the schema and the claim', () => {
    const fill = yaml.load(fs.readFileSync(path.join(folder, 'overlays/large/fill.yaml'), 'utf8'));
    assert.deepEqual(schema_problems([fill]), []);
    assert.equal(fill.spec.containers[0].image, of('overlays/large', 'StatefulSet').spec.template.spec.containers[0].image);
    assert.equal(fill.spec.volumes[0].persistentVolumeClaim.claimName,
        of('overlays/large', 'PersistentVolumeClaim').metadata.name);
});

// Each of these breaks one thing that a person could get wrong, with the problem that must be found.
const breaks = [
    ['a misspelt field', d => { pod(d).containers[0].imagePullPolcy = 'Never'; }, /imagePullPolcy/],
    ['a misspelt field of a probe', d => { pod(d).containers[0].readinessProbe.periodSecond = 5; }, /periodSecond/],
    ['a field at the wrong level', d => { server(d).spec.terminationGracePeriodSeconds = 5; }, /terminationGracePeriod/],
    ['a number as text', d => { server(d).spec.replicas = '4'; }, /replicas must be integer/],
    ['a choice that does not exist', d => { server(d).spec.podManagementPolicy = 'Serial'; }, /podManagementPolicy/],
    ['a missing field', d => { delete server(d).spec.selector; }, /selector/],
    ['a kind that does not exist', d => { server(d).kind = 'StatefullSet'; }, /no such kind/],
    ['labels that nobody selects', d => { server(d).spec.template.metadata.labels = {}; }, /does not select its own pods/],
    ['a Service for nobody', d => { service(d).spec.selector['app.kubernetes.io/component'] = 'severs'; }, /selects 0/],
    ['a port that nobody opens', d => { service(d).spec.ports[0].targetPort = 'swaths'; }, /no container has the port/],
    ['a Service that hides the servers', d => { delete service(d).spec.clusterIP; }, /hides its servers/],
    ['a flag that no program has', d => { pod(d).containers[0].args.push('--lisen=1'); }, /has no --lisen/],
    ['a probe that no program knows', d => { pod(d).containers[0].livenessProbe.exec.command[2] = '--healthy'; },
        /has no --healthy/],
    ['a setting that nothing sets', d => { delete find(d, 'ConfigMap').data.SIZE; }, /nothing sets SIZE/],
    ['a volume that is not there', d => { pod(d).volumes = []; }, /no volume cache/],
    ['root', d => { delete pod(d).securityContext.runAsNonRoot; }, /may run as root/],
    ['an open network', d => { find(d, 'NetworkPolicy').spec.ingress = [{}]; }, /lets everybody in/],
];
const find = (all, kind, name) => all.find(d => d.kind === kind && (!name || d.metadata.name === name));
const server = all => find(all, 'StatefulSet') ?? find(all, 'StatefullSet');
const pod = all => server(all).spec.template.spec;
const service = all => find(all, 'Service', 'swath-server');

for (const [what, change, heard] of breaks)
    test(`${what} is found`, () => {
        const broken = structuredClone(documents.get('base'));
        change(broken);
        assert.match(problems(broken).join('\n'), heard);
    });
