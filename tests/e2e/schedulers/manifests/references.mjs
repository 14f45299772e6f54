// Checks what no schema can: that documents fit each other, and the programs. One line for each problem.

const container_kinds = ['Deployment', 'StatefulSet', 'DaemonSet', 'Job'];
const covers = (selector, labels) => Object.entries(selector ?? {}).every(([key, value]) => labels?.[key] === value);

function workloads(documents) {
    return documents.filter(({kind}) => container_kinds.includes(kind)).map(document => ({
        name: `${document.kind} ${document.metadata.name}`,
        document,
        labels: document.spec.template.metadata.labels,
        pod: document.spec.template.spec,
    }));
}

// The command lines of the program and of each probe, from `command` and `args`.
function commands(container) {
    const probes = ['startupProbe', 'readinessProbe', 'livenessProbe'].flatMap(
        probe => (container[probe] ? [container[probe].exec?.command ?? []] : []));
    return [[...(container.command ?? []), ...(container.args ?? [])], ...probes];
}

// `help` is the output of a program's --help, or undefined if there is no such program.
export function reference_problems(documents, help) {
    const problems = [];
    const expect = (right, text) => right || problems.push(text);
    const of_kind = kind => documents.filter(document => document.kind === kind);
    const find = (kind, name) => of_kind(kind).find(document => document.metadata.name === name);
    const pods = workloads(documents);

    for (const document of documents) {
        const name = `${document.kind} ${document.metadata.name}`;
        expect(document.metadata.labels?.['app.kubernetes.io/name'] === 'swath' || document.kind === 'ConfigMap',
            `${name} has no app.kubernetes.io/name`);
        expect(document.kind === 'Namespace' || document.metadata.namespace === 'swath', `${name} is in no namespace`);
    }
    for (const service of of_kind('Service')) {
        const name = `Service ${service.metadata.name}`;
        const backs = pods.filter(({labels}) => covers(service.spec.selector, labels));
        expect(backs.length === 1, `${name} selects ${backs.length} workloads`);
        for (const port of service.spec.ports)
            expect(backs.every(({pod}) => pod.containers.some(
                ({ports}) => ports?.some(p => p.name === port.targetPort || p.containerPort === port.targetPort))),
            `${name}: no container has the port ${port.targetPort}`);
    }
    for (const budget of of_kind('PodDisruptionBudget'))
        expect(pods.some(({labels}) => covers(budget.spec.selector.matchLabels, labels)),
            `PodDisruptionBudget ${budget.metadata.name} selects nothing`);
    for (const policy of of_kind('NetworkPolicy')) {
        for (const {name, labels} of pods)
            expect(covers(policy.spec.podSelector.matchLabels, labels), `NetworkPolicy leaves ${name} open`);
        for (const rule of policy.spec.ingress) {
            expect(rule.from?.length > 0, 'NetworkPolicy lets everybody in');
            for (const {port} of rule.ports ?? [])
                expect(pods.some(({pod}) => pod.containers.some(({ports}) => ports?.some(p => p.name === port))),
                    `NetworkPolicy: no container has the port ${port}`);
        }
    }

    for (const {name, document, labels, pod} of pods) {
        expect(covers(document.spec.selector.matchLabels, labels), `${name} does not select its own pods`);
        if (document.kind === 'StatefulSet')
            expect(find('Service', document.spec.serviceName)?.spec.clusterIP === 'None',
                `${name}: ${document.spec.serviceName} is no headless Service`);
        const volumes = pod.volumes ?? [];
        for (const {persistentVolumeClaim: claim} of volumes)
            expect(!claim || find('PersistentVolumeClaim', claim.claimName), `${name}: no claim ${claim?.claimName}`);

        // Pod security "restricted", and a root file system that cannot be written.
        const runs_as = pod.securityContext ?? {};
        expect(runs_as.runAsNonRoot === true && runs_as.runAsUser > 0, `${name} may run as root`);
        expect(runs_as.seccompProfile?.type === 'RuntimeDefault', `${name} has no seccomp profile`);
        expect(pod.automountServiceAccountToken === false, `${name} is given a token for the API server`);
        for (const container of pod.containers) {
            const may = container.securityContext ?? {};
            expect(may.allowPrivilegeEscalation === false && may.readOnlyRootFilesystem === true &&
                may.capabilities?.drop?.includes('ALL') && !may.capabilities.add, `${name} may do too much`);
            for (const of of ['requests', 'limits'])
                expect(container.resources?.[of]?.cpu && container.resources[of].memory, `${name} has no ${of}`);
            for (const mount of container.volumeMounts ?? [])
                expect(volumes.some(volume => volume.name === mount.name), `${name}: no volume ${mount.name}`);
            expect(container.volumeMounts?.some(mount => mount.mountPath === '/cache'), `${name} has no /cache`);

            const variables = (container.env ?? []).map(variable => variable.name);
            for (const {configMapRef: map} of container.envFrom ?? []) {
                expect(find('ConfigMap', map.name), `${name}: no ConfigMap ${map.name}`);
                variables.push(...Object.keys(find('ConfigMap', map.name)?.data ?? {}));
            }
            for (const command of commands(container)) {
                const [program, ...args] = command;
                const text = help(program);
                expect(text !== undefined, `${name}: no program ${program}`);
                for (const arg of args) {
                    for (const [, variable] of arg.matchAll(/\$\((\w+)\)/g))
                        expect(variables.includes(variable), `${name}: nothing sets ${variable}`);
                    const [flag] = arg.match(/^--[a-z-]+/) ?? [];
                    expect(!flag || text?.match(new RegExp(`${flag}\\b(?!-)`)), `${name}: ${program} has no ${flag}`);
                    const [, kind, host, port] = arg.match(/^--(servers|display)=(?:dns:)?([a-z-]+):(\d+)$/) ?? [];
                    if (!host) continue;
                    const service = find('Service', host);
                    expect(service?.spec.ports.some(p => p.port === Number(port)), `${name}: no Service ${host}:${port}`);
                    expect(kind !== 'servers' || service?.spec.clusterIP === 'None', `${name}: ${host} hides its servers`);
                }
            }
        }
    }
    return problems;
}
