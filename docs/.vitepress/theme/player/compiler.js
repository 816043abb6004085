// The worker that compiles a stage in its page (docs/.vitepress/compiler.mjs made its files). Messages are {id, call:
// 'load'} and {id, call: 'compile', text, stage: {id, stem, folder}}; answers {id, wasm}, {id, errors: [{line, column,
// words}]} or {id, error}; while it loads, {loaded, of}: bytes.
import { Refused, run, treeOf } from './llvm.mjs'

const folder = new URL('compiler/', import.meta.url)

// Files are kept by the browser, where it lets pages keep anything: the next time, and offline, they are there. Each edition
// of the book has its own.
const plainFetch = globalThis.fetch.bind(globalThis)
const open = async (name) => globalThis.caches?.open(name).catch(() => undefined)
let edition = ''
async function fetchKept(name) {
  const address = new URL(name, folder)
  const kept = await open('relief-compiler ' + edition)
  const there = await kept?.match(address)
  if (there !== undefined) return there
  const response = await plainFetch(address)
  if (!response.ok) throw new Error(`${name}: ${response.status}; it cannot be loaded`)
  await kept?.put(address, response.clone()).catch(() => {})
  return response
}

// What there is to load, of this edition: {key, flags, linking, libraries, registry, sizes}. Offline, of the last one.
async function fetchMade() {
  const address = new URL('made.json', folder)
  const last = await open('relief-compiler')
  const response = await plainFetch(address, { cache: 'no-cache' }).catch(() => last?.match(address))
  if (!response?.ok) throw new Error('made.json: cannot be loaded; are you offline?')
  await last?.put(address, response.clone()).catch(() => {})
  const made = await response.json()
  edition = made.key
  for (const name of await globalThis.caches?.keys().catch(() => []) ?? []) {
    if (name.startsWith('relief-compiler ') && name !== 'relief-compiler ' + edition) await caches.delete(name)
  }
  return made
}

let loaded = 0, of = 0
async function fetched(name) {
  const response = await fetchKept(name + '.gz')
  const counted = new TransformStream({
    transform(chunk, controller) {
      loaded += chunk.byteLength
      postMessage({ loaded, of })
      controller.enqueue(chunk)
    }
  })
  return new Response(response.body.pipeThrough(counted).pipeThrough(new DecompressionStream('gzip')),
    { headers: { 'Content-Type': name.endsWith('.wasm') ? 'application/wasm' : 'application/octet-stream' } })
}

// What the compiler's own script asks for is compressed here.
globalThis.fetch = (address, options) => {
  const name = new URL(address).pathname.split('/').at(-1)
  return String(address).startsWith(folder.href) && /\.(wasm|tar)$/.test(name) ? fetched(name) : plainFetch(address, options)
}

const bytesOf = async (name) => new Uint8Array(await (await fetched(name)).arrayBuffer())

let tools = null
function load() {
  tools ??= (async () => {
    const made = await fetchMade()
    of = Object.values(made.sizes).reduce((sum, { packed }) => sum + packed, 0)
    const libraryNames = made.libraries.map((name) => `lib${name}.a`)
    const [{ commands }, headers, precompiled, base, ...libraries] = await Promise.all([
      import(new URL('bundle.js', folder)), bytesOf('headers.json'), bytesOf('headers.pch'), bytesOf('base.o'), ...libraryNames.map(bytesOf)])
    const files = treeOf(JSON.parse(new TextDecoder().decode(headers)))
    const all = {
      ...made, commands, files: { ...files, 'headers.pch': precompiled }, base, libraryNames,
      archives: Object.fromEntries(libraryNames.map((name, i) => [name, libraries[i]]))
    }
    await run(commands, 'clang++', ['--version'], {})
    return all
  })()
  tools.catch(() => { tools = null })
  return tools
}

// The file, and behind it the list of this program's stages (samples/common/registry.cpp.in): itself. Null: it is no stage.
function program(text, stage, registry) {
  const [, name] = [...text.matchAll(/^Stage\s+(\w+)\s*\(\s*\)/gm)].at(-1) ?? []
  if (name === undefined) return null
  const call = `registered(${name}(), "${stage.id}", "${stage.stem}", "${stage.folder}", ""),\n`
  return `${text}\n#line 1 "registry.cpp"\n` +
    registry.replace('@stage_declarations@', `Stage ${name}();\n`).replace('@stage_calls@', call)
}

// clang's lines about the reader's file: "08_along_v.cpp:46:28: error: ...".
function errorsOf(said, file) {
  const errors = said.split('\n').map((line) => line.match(/^(?:\/)?(.*?):(\d+):(\d+): (?:fatal )?error: (.*)/)).filter((match) => match !== null)
    .map(([, name, line, column, words]) => ({ line: name === file ? Number(line) : 0, column: Number(column), words: name === file ? words : `${name}: ${words}` }))
  return errors.length > 0 ? errors : [{ line: 0, column: 0, words: said.trim().split('\n')[0] }]
}

const calls = {
  async load() {
    await load()
    return {}
  },
  async compile({ text, stage }) {
    const all = await load()
    const file = stage.stem + '.cpp'
    const whole = program(text, stage, all.registry)
    if (whole === null) {
      return { errors: [{ line: 0, column: 0, words: `there is no function \`Stage NAME()\` at the beginning of a line; ${file} ends with one` }] }
    }
    try {
      const compiled = await run(all.commands, 'clang++', [...all.flags, '-include-pch', '/headers.pch', '-Xclang', '-fno-validate-pch', '-c', '/' + file, '-o', '/stage.o'],
        { ...all.files, [file]: whole })
      const names = all.libraryNames.map((name) => '/' + name)
      const linked = await run(all.commands, 'wasm-ld', ['/stage.o', '/base.o', ...names, '-o', '/stage.wasm', ...all.linking],
        { 'stage.o': compiled['stage.o'], 'base.o': all.base, ...all.archives })
      return { wasm: linked['stage.wasm'] }
    } catch (error) {
      if (error instanceof Refused) return { errors: errorsOf(error.message, file) }
      throw error
    }
  }
}

addEventListener('message', async ({ data }) => {
  try {
    postMessage({ id: data.id, ...await calls[data.call](data) })
  } catch (error) {
    postMessage({ id: data.id, error: error.message })
  }
})
