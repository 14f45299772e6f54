// docker/swarm: the compose file and the Swarm's additions, merged as `docker stack deploy` does. This needs
// the docker command, but no engine. SWATH_PROGRAMS is the folder of the programs.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import test from 'node:test';
import {fileURLToPath} from 'node:url';
import yaml from 'js-yaml';

const folder = fileURLToPath(new URL('../../../../docker/', import.meta.url));
const files = ['compose.yaml', 'swarm/stack.yaml'].map(name => path.join(folder, name));

function config(environment, stack_files = files) {
    const env = {PATH: process.env.PATH, HOME: process.env.HOME, ...environment};
    return spawnSync('docker', ['stack', 'config', ...stack_files.flatMap(file => ['-c', file])], {encoding: 'utf8', env});
}
const {stdout, stderr, status} = config({SWATH_HOST: 'node.example'});
const {services} = yaml.load(stdout) ?? {};

test('docker merges both files', () => {
    assert.equal(status, 0, stderr);
    assert.deepEqual(Object.keys(services).sort(), ['client', 'display', 'server']);
    assert.deepEqual([...new Set(Object.values(services).map(service => service.image))], ['swath']);
});

test('the servers\' name stands for every task', () => {
    assert.equal(services.server.deploy.endpoint_mode, 'dnsrr');
    assert.equal(services.server.deploy.placement.max_replicas_per_node, 1);
    assert.equal(services.server.ports, undefined);  // a service with all its addresses cannot have ports
    assert.ok(services.client.command.includes('--servers=dns:server:4000'));
});

test('the page is published on one node and asks for its token', () => {
    assert.deepEqual(services.display.ports, [{mode: 'host', target: 8080, published: 8080}]);
    assert.ok(services.display.command.includes('--view-at=node.example:8080'));
    assert.deepEqual(services.display.deploy.placement.constraints, ['node.labels.swath == here']);
    assert.equal(services.client.ports, undefined);
});

test('without the node\'s name there is no stack', () => {
    const {status, stderr} = config({});
    assert.notEqual(status, 0);
    assert.match(stderr, /SWATH_HOST/);
});

test('what programs write to can be written to, in a stack too', () => {
    for (const [name, {read_only, volumes}] of Object.entries(services)) {
        assert.equal(read_only, true, name);
        for (const target of ['/cache', '/tmp'])
            assert.ok(volumes.some(volume => volume.target === target && volume.type === 'tmpfs'), `${name} ${target}`);
    }
});

test('only the labelled node needs the folder of models', () => {
    const binds = name => (services[name].volumes ?? []).filter(({type}) => type === 'bind');
    assert.deepEqual(binds('server'), []);
    assert.deepEqual(binds('display'), []);
    assert.deepEqual(binds('client').map(({target}) => target), ['/models']);
    assert.deepEqual(services.client.deploy.placement.constraints, ['node.labels.swath == here']);
});

test('commands and health checks are the programs\' own', () => {
    for (const {command, healthcheck} of Object.values(services))
        for (const [program, ...args] of [command, healthcheck?.test.slice(1)].filter(words => words)) {
            const help = execFileSync(path.join(process.env.SWATH_PROGRAMS, program), ['--help'], {encoding: 'utf8'});
            for (const [flag] of args.flatMap(arg => [...arg.matchAll(/^--[a-z-]+/g)]))
                assert.match(help, new RegExp(`${flag}\\b(?!-)`), program);
        }
});

test('a misspelt key is found', () => {
    const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'swath-stack-'));
    try {
        const broken = path.join(scratch, 'stack.yaml');
        fs.writeFileSync(broken, fs.readFileSync(files[1], 'utf8').replace('endpoint_mode', 'endpoint_mood'));
        const {status, stderr} = config({SWATH_HOST: 'node.example'}, [files[0], broken]);
        assert.notEqual(status, 0);
        assert.match(stderr, /endpoint_mood/);
    } finally {
        fs.rmSync(scratch, {recursive: true});
    }
});
