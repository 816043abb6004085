// Makes what compiles a stage in its page: clang and its linker as WebAssembly (@yowasp/clang), the headers that a stage
// includes, precompiled, and all of relief_web but its stages, ready to be linked. Each is a file compressed by gzip, so
// that any host will do. Run by ./relief book after relief_web is built:
//
//   node compiler.mjs BUILD     the build folder of emscripten; writes BUILD/compiler
import crypto from 'node:crypto'
import fs from 'node:fs'
import path from 'node:path'
import { execFileSync } from 'node:child_process'
import { createRequire } from 'node:module'
import { fileURLToPath } from 'node:url'
import zlib from 'node:zlib'
import { commands } from '@yowasp/clang'
import { root } from './stages.mjs'
import { run, treeOf } from './theme/player/llvm.mjs'

const build = path.resolve(process.argv[2])
const out = path.join(build, 'compiler')
const sysroot = path.join(execFileSync('em-config', ['CACHE'], { encoding: 'utf8' }).trim(), 'sysroot')
const archives = path.join(sysroot, 'lib/wasm32-emscripten')
const libraries = ['stubs', 'noexit', 'c', 'dlmalloc', 'compiler_rt', 'c++-noexcept', 'c++abi-noexcept']

// As em++ and the build compile a stage, but -O1: an edit is to be seen soon.
const emscripten = execFileSync('em++', ['--cflags'], { encoding: 'utf8' }).trim().split(/\s+/)
  .map((word) => word.replace(sysroot, '/sysroot'))
const isForeign = (word, before) => word.includes('/SDL') || ['-combiner-global-alias-analysis=false', '-enable-emscripten-sjlj',
  '-disable-lsr', '-mllvm'].includes(word) || (word === '-Xclang' && before)
const flags = [
  ...emscripten.filter((word, i) => !isForeign(word, emscripten[i + 1]?.includes('/SDL'))),
  '-msimd128', '-O1', '-std=c++20', '-w', '-fno-caret-diagnostics', '-ffp-contract=off', '-fno-math-errno', '-fno-trapping-math', '-DRELIEF_LANES=4', '-DRELIEF_NO_THREADS',
  '-DRELIEF_OPTIONS', '-DRELIEF_BINORMAL_PER_FRAGMENT=0', '-DNDEBUG', '-I/relief/engine', '-I/relief/samples', '-isystem', '/relief/libraries',
  '-isystem', '/sysroot/include/c++/v1', '-isystem', '/sysroot/include', '-fpch-instantiate-templates'
]
const exported = [...fs.readFileSync(path.join(root, 'samples/web/exports.cpp'), 'utf8').replace(/#ifdef RELIEF_WEB_TRACE[\s\S]*?#endif/g, '')
  .matchAll(/EMSCRIPTEN_KEEPALIVE.* \*?(relief_\w+)\(/g)].map((match) => match[1])
const registry = fs.readFileSync(path.join(root, 'samples/common/registry.cpp.in'), 'utf8')
const linking = [
  '--import-undefined', '--no-stack-first', '--strip-debug', '--export-if-defined=__start_em_asm', '--export-if-defined=__stop_em_asm',
  ...['stackSave', 'stackRestore', 'stackAlloc', '__wasm_call_ctors', '__errno_location', 'malloc', 'free', ...exported].map((name) => '--export=' + name),
  '--export-table', '-z', 'stack-size=1048576', '--initial-memory=67108864', '--no-entry', '--max-memory=2147483648', '--global-base=1024'
]

// --- headers, by the names that they have in the page ---

const headers = {}
function add(from, to, change = (text) => text) {
  for (const entry of fs.readdirSync(from, { withFileTypes: true })) {
    const [file, name] = [path.join(from, entry.name), path.posix.join(to, entry.name)]
    if (fs.statSync(file).isDirectory()) add(file, name, change)
    else headers[name] = change(fs.readFileSync(file, 'utf8'), name)
  }
}
for (const entry of fs.readdirSync(path.join(sysroot, 'include'))) {
  if (/^(AL|EGL|GL|GLES\d?|GLFW|KHR|SDL\d?|X11|webgpu)$/.test(entry)) continue
  const file = path.join(sysroot, 'include', entry)
  if (fs.statSync(file).isDirectory()) add(file, 'sysroot/include/' + entry)
  else headers['sysroot/include/' + entry] = fs.readFileSync(file, 'utf8')
}
add(path.join(root, 'engine/relief'), 'relief/engine/relief')
add(path.join(root, 'samples/common'), 'relief/samples/common')
for (const name of Object.keys(headers)) {
  if (name.startsWith('relief/') && !name.endsWith('.h')) delete headers[name]
}
// The compiler's files know no "..".
add('/usr/include/glm', 'relief/libraries/glm', (text, name) => text.replace(/#(\s*)include "([^"]+)"/g,
  (all, space, file) => `#${space}include <${path.posix.relative('relief/libraries', path.posix.join(path.posix.dirname(name), file))}>`))
add('/usr/include/tl', 'relief/libraries/tl')

// --- what is there already is not made again ---

const objects = ['samples/web/CMakeFiles/relief_web.dir/exports.cpp.o', 'samples/web/librelief_player.a', 'samples/librelief_common.a',
  ...fs.readdirSync(path.join(build, 'engine')).filter((name) => name.endsWith('.a')).map((name) => 'engine/' + name)]
const read = (file) => new Uint8Array(fs.readFileSync(file))
const hash = crypto.createHash('sha256').update(JSON.stringify([flags, linking, headers, registry])).update(fs.readFileSync(fileURLToPath(import.meta.url)))
for (const object of objects) hash.update(read(path.join(build, object)))
const key = hash.digest('hex')
const stamp = path.join(out, 'made.json')
if (fs.existsSync(stamp) && JSON.parse(fs.readFileSync(stamp, 'utf8')).key === key) process.exit(0)

fs.rmSync(out, { recursive: true, force: true })
fs.mkdirSync(out, { recursive: true })
const sizes = {}
function write(name, bytes) {
  const packed = zlib.gzipSync(bytes, { level: 9 })
  fs.writeFileSync(path.join(out, name + '.gz'), packed)
  sizes[name] = { bytes: bytes.length, packed: packed.length }
}

const precompiled = await run(commands, 'clang++', [...flags, '-x', 'c++-header', '/relief/samples/common/stage_headers.h', '-o', '/headers.pch'], treeOf(headers))
write('headers.pch', precompiled['headers.pch'])

const inputs = Object.fromEntries(objects.map((object) => [path.basename(object), read(path.join(build, object))]))
const libraryFiles = Object.fromEntries(libraries.map((name) => [`lib${name}.a`, read(path.join(archives, `lib${name}.a`))]))
const names = libraries.map((name) => `/lib${name}.a`)
const base = await run(commands, 'wasm-ld', ['-r', '-o', '/base.o', '--whole-archive', ...Object.keys(inputs).map((name) => '/' + name), '--no-whole-archive', ...names],
  { ...inputs, ...libraryFiles })
write('base.o', base['base.o'])
for (const [name, bytes] of Object.entries(libraryFiles)) write(name, bytes)
write('headers.json', Buffer.from(JSON.stringify(headers)))

// --- the compiler itself, without what is for other systems ---

const gen = path.dirname(createRequire(import.meta.url).resolve('@yowasp/clang'))
for (const name of fs.readdirSync(gen)) {
  if (name.endsWith('.wasm')) write(name, fs.readFileSync(path.join(gen, name)))
}
fs.copyFileSync(path.join(gen, 'bundle.js'), path.join(out, 'bundle.js'))
const tar = fs.readFileSync(path.join(gen, 'llvm-resources.tar'))
const kept = []
for (let at = 0; at + 512 <= tar.length && tar[at] !== 0;) {
  const text = (begin, size) => tar.subarray(at + begin, at + begin + size).toString('latin1').split('\0')[0]
  const name = (text(345, 155) === '' ? '' : text(345, 155) + '/') + text(0, 100)
  const end = at + 512 + Math.ceil(parseInt(text(124, 12), 8) / 512) * 512
  const isFolder = text(156, 1) === '5'
  const isWanted = isFolder || name.startsWith('include/') && !/include\/(c\+\+|wasm32-|sanitizer|.*(opencl|cuda|hip|spirv|altivec|avx|neon|sve|hexagon|vecintrin|arm_|mm|riscv))/.test(name)
  if (isWanted) kept.push(tar.subarray(at, end))
  at = end
}
write('llvm-resources.tar', Buffer.concat([...kept, Buffer.alloc(1024)]))

fs.writeFileSync(stamp, JSON.stringify({ key, flags, linking, libraries, registry, sizes }))
const total = Object.values(sizes).reduce((sum, { packed }) => sum + packed, 0)
console.log(`the compiler for pages: ${(total / 1e6).toFixed(1)} MB compressed`)
