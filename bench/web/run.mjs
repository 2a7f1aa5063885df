// node bench/web/run.mjs <carom-web.wasm> <native carom-web> [runs]: three scenes on Carom's WebAssembly and on its peers' in Node, each run in a process of its own, one engine
// after the other. Prints medians of a step's mean time in ms, and what Carom takes of each peer's.
//   cmake -S . -B build/wasm -DCMAKE_TOOLCHAIN_FILE=cmake/wasm.cmake -DCAROM_INSTALL=OFF -DCAROM_BUILD_TESTS=OFF -DCAROM_BUILD_PINBALL=OFF -DCAROM_BUILD_LAB=OFF
//   cmake --build build/wasm --target carom-web && (cd bench/web && npm install)
//   node bench/web/run.mjs build/wasm/bin/carom-web.wasm build/release/bin/carom-web

import { execFileSync } from 'node:child_process';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { peers } from './peers.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const names = ['pyramid', 'tumbler', 'pile'];

const node = (...args) => execFileSync(process.execPath, ['--no-warnings', ...args], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'], maxBuffer: 1 << 28 });
const carom = (program, ...args) => JSON.parse(node(join(here, '../../scripts/run-wasm.mjs'), program, ...args));
const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];

async function run_peer(engine, native, name)
{
    const scene = JSON.parse(execFileSync(native, ['--describe', name], { encoding: 'utf8', maxBuffer: 1 << 28 }));
    const world = await peers[engine](scene);
    for (let i = 0; i < scene.warm_up; ++i)
        world.step();
    const start = performance.now();
    for (let i = scene.warm_up; i < scene.steps; ++i)
        world.step();
    console.log(JSON.stringify({ ms: (performance.now() - start) / (scene.steps - scene.warm_up), height: world.height() }));
    process.exit(0);
}

const [first, second, third, fourth] = process.argv.slice(2);
if (second === undefined) {
    console.error('run.mjs: which carom-web.wasm, and which native carom-web?');
    process.exit(2);
} else if (first === '--peer') {
    await run_peer(second, third, fourth);
} else {
    const program = resolve(first);
    const native = resolve(second);
    const runs = Number(third ?? 5);
    const engines = { carom: (name) => carom(program, name) };
    for (const peer of Object.keys(peers))
        engines[peer] = (name) => JSON.parse(node(fileURLToPath(import.meta.url), '--peer', peer, native, name));
    console.log(['scene', ...Object.keys(engines).map((e) => e + ' ms'), ...Object.keys(peers).map((p) => 'carom/' + p), 'mean heights m'].join('\t'));
    for (const name of names) {
        const times = {}, heights = {};
        for (let i = 0; i < runs; ++i) {
            for (const engine of Object.keys(engines)) {
                process.stderr.write(process.stderr.isTTY ? `\r\x1b[K${name}: run ${i + 1} of ${runs}, ${engine}` : '');
                const { ms, height } = engines[engine](name);
                (times[engine] ??= []).push(ms);
                heights[engine] = height.toFixed(3);
            }
        }
        process.stderr.write(process.stderr.isTTY ? '\r\x1b[K' : '');
        const ms = Object.keys(engines).map((e) => median(times[e]));
        console.log([name, ...ms.map((x) => x.toFixed(3)), ...ms.slice(1).map((x) => (ms[0] / x).toFixed(3)), Object.values(heights).join(' ')].join('\t'));
    }
}
