// Checks a document against Kubernetes' published schemas. Two readings of the same OpenAPI description:
// compiled validators know required fields, types, choices and formats; the types, checked by the TypeScript
// compiler, know every field's name, so that a misspelt one is found as well.
import {createRequire} from 'node:module';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import ts from 'typescript';

const require = createRequire(import.meta.url);
const here = path.dirname(fileURLToPath(import.meta.url));

function module_of({apiVersion, kind}) {
    const [group, version] = apiVersion.includes('/') ? apiVersion.split('/') : ['', apiVersion];
    return ['kubernetes-models', group, version, kind].filter(part => part).join('/');
}

function invalid_values(document) {
    let Model;
    try {
        Model = require(module_of(document))[document.kind];
    } catch {
        return [`${document.apiVersion} ${document.kind}: no such kind`];
    }
    try {
        new Model(document).validate();
        return [];
    } catch (error) {
        return [error.message];
    }
}

function unknown_fields(documents) {
    const name = path.join(here, 'documents.ts');
    const text = documents
        .map((document, i) => `import type {I${document.kind} as T${i}} from '${module_of(document)}';\n` +
            `export const d${i}: T${i} = ${JSON.stringify(document, null, 1)};\n`)
        .join('');
    const options = {strict: true, noEmit: true, skipLibCheck: true, types: [], module: ts.ModuleKind.CommonJS,
        moduleResolution: ts.ModuleResolutionKind.Node10, lib: ['lib.es2020.d.ts']};
    const host = ts.createCompilerHost(options);
    const {fileExists, getSourceFile, readFile} = host;
    host.fileExists = file => file === name || fileExists.call(host, file);
    host.readFile = file => (file === name ? text : readFile.call(host, file));
    host.getSourceFile = (file, ...rest) =>
        (file === name ? ts.createSourceFile(file, text, rest[0]) : getSourceFile.call(host, file, ...rest));
    const program = ts.createProgram([name], options, host);
    return ts.getPreEmitDiagnostics(program).map(({messageText, file, start}) => {
        const line = file ? file.text.slice(0, start).split('\n').length : 0;
        const near = file ? file.text.split('\n')[line - 1].trim() : '';
        return `${near}: ${ts.flattenDiagnosticMessageText(messageText, ' ')}`;
    });
}

// One line for each problem, none for good documents.
export function schema_problems(documents) {
    const values = documents.flatMap(invalid_values);
    const known = documents.filter(document => !invalid_values(document).some(text => text.endsWith('no such kind')));
    return [...values, ...unknown_fields(known)];
}
