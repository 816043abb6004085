// The worker that compiles a stage in its page (docs/.vitepress/compiler.mjs made its files). Messages are {id, call:
// 'load'} and {id, call: 'compile', text, name, stage: {id, stem, folder}}; answers {id, wasm}, {id, errors: [{line, column,
// words}]} or {id, error}; while it loads, {loaded, of}: bytes.
const folder = new URL('compiler/', import.meta.url)

let loaded = 0, of = 0
async function fetched(name) {
  const response = await fetchCached(new URL(name + '.gz', folder))
  if (!response.ok) throw new Error(`${name}: ${response.status}; it cannot be loaded`)
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

// Kept by the browser, where it lets pages keep anything: the next time, and offline, it is there.
const plainFetch = globalThis.fetch.bind(globalThis)
async function fetchCached(address) {
  const cache = await globalThis.caches?.open('relief-compiler').catch(() => undefined)
  const there = await cache?.match(address)
  if (there !== undefined) return there
  const response = await plainFetch(address)
  if (response.ok) await cache?.put(address, response.clone()).catch(() => {})
  return response
}

// What the compiler's own script asks for is compressed here.
globalThis.fetch = (address, options) => {
  const name = new URL(address).pathname.split('/').at(-1)
  return String(address).startsWith(folder.href) && /\.(wasm|tar)$/.test(name) ? fetched(name) : plainFetch(address, options)
}

const bytesOf = async (name) => new Uint8Array(await (await fetched(name)).arrayBuffer())

function treeOf(files) {
  const tree = {}, encoder = new TextEncoder()
  for (const [name, text] of Object.entries(files)) {
    const parts = name.split('/')
    let at = tree
    for (const part of parts.slice(0, -1)) at = at[part] ??= {}
    at[parts.at(-1)] = encoder.encode(text)
  }
  return tree
}

let tools = null
function load() {
  tools ??= (async () => {
    const made = await (await fetchCached(new URL('made.json', folder))).json()
    of = Object.values(made.sizes).reduce((sum, { packed }) => sum + packed, 0)
    const libraryNames = made.libraries.map((name) => `lib${name}.a`)
    const [{ commands }, headers, precompiled, base, ...libraries] = await Promise.all([
      import(new URL('bundle.js', folder)), bytesOf('headers.json'), bytesOf('headers.pch'), bytesOf('base.o'), ...libraryNames.map(bytesOf)])
    const files = treeOf(JSON.parse(new TextDecoder().decode(headers)))
    const all = {
      ...made, commands, files: { ...files, 'headers.pch': precompiled }, base, libraryNames,
      archives: Object.fromEntries(libraryNames.map((name, i) => [name, libraries[i]]))
    }
    await run(all, 'clang++', ['--version'], {})
    return all
  })()
  tools.catch(() => { tools = null })
  return tools
}

class Refused extends Error {}

async function run(all, program, words, files) {
  let said = ''
  const listen = (bytes) => { if (bytes) said += new TextDecoder().decode(bytes) }
  try {
    return await all.commands[program](words, files, { stdout: listen, stderr: listen, fetchProgress: () => {} })
  } catch (error) {
    throw new Refused(said === '' ? error.message : said)
  }
}

// The file, and behind it the list of this program's stages: itself.
function program(text, stage) {
  const [, name] = [...text.matchAll(/^Stage\s+(\w+)\s*\(\s*\)/gm)].at(-1) ?? []
  if (name === undefined) return null
  return text + `
#line 1 "the list of stages"
namespace relief::samples {
const std::vector<Stage>& allStages()
{
    static const std::vector<Stage> all = [] {
        Stage stage = ${name}();
        stage.id = "${stage.id}", stage.stem = "${stage.stem}", stage.folder = "${stage.folder}";
        return std::vector<Stage>{stage};
    }();
    return all;
}
Expected<const Stage*> findStage(const std::string& name)
{
    return findByName(allStages(), name);
}
}  // namespace relief::samples
`
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
    const whole = program(text, stage)
    if (whole === null) {
      return { errors: [{ line: 0, column: 0, words: `there is no function \`Stage NAME()\` at the beginning of a line; ${file} ends with one` }] }
    }
    try {
      const compiled = await run(all, 'clang++', [...all.flags, '-include-pch', '/headers.pch', '-Xclang', '-fno-validate-pch', '-c', '/' + file, '-o', '/stage.o'],
        { ...all.files, [file]: whole })
      const names = all.libraryNames.map((name) => '/' + name)
      const linked = await run(all, 'wasm-ld', ['/stage.o', '/base.o', ...names, '-o', '/stage.wasm', ...all.linking],
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
