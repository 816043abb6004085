// The worker that judges pictures, by the same code as ./relief doctor and ./relief check-exercise. Messages are {id, call,
// ...}; answers {id, ...} or {id, error}.
const folder = new URL('.', import.meta.url)
const module = import(new URL('relief_judge.mjs', folder)).then(({ default: create }) => create())
const exercises = new Map()  // by the folder's name: promises

async function ask(name, types, values) {
  const said = (await module).ccall('relief_' + name, 'string', types, values)
  if (said.startsWith('error: ')) throw new Error(said.slice(7))
  return said
}

// An exercise's files, in a folder of its name.
async function loadExercise(name, files) {
  const { FS } = await module
  const bytes = await Promise.all(files.map(async (file) => {
    const response = await fetch(new URL(`exercises/${name}/${file}`, folder))
    if (!response.ok) throw new Error(`${name}/${file}: ${response.status}; it cannot be loaded`)
    return response.arrayBuffer()
  }))
  FS.mkdirTree(`/${name}/answer`)
  files.forEach((file, i) => FS.writeFile(`/${name}/${file}`, new Uint8Array(bytes[i])))
}

const calls = {
  // map, heights, mesh: {name, bytes} or null. {text, shows, evidence, cured}: the pictures as the bytes of PNG files.
  async examine({ map, heights, mesh }) {
    const { FS } = await module
    const names = [map, heights, mesh].map((file, i) => {
      if (file === null) return ''
      const name = ['', 'heights ', 'mesh '][i] + file.name.replace(/\//g, '_')
      FS.writeFile('/' + name, new Uint8Array(file.bytes))
      return name
    })
    const take = (name) => {
      if (!FS.analyzePath(name).exists) return null
      const bytes = FS.readFile(name)
      FS.unlink(name)
      return bytes
    }
    try {
      const [shows, ...lines] = (await ask('examine', ['string', 'string', 'string'], names)).split('\n')
      return { shows, text: lines.join('\n').trim(), evidence: take('/evidence.png'), cured: take('/cured.png') }
    } finally {
      for (const name of names) if (name !== '') FS.unlink('/' + name)
    }
  },
  // {kind, sentence} of an exercise's picture at rest.
  async diagnose({ folder, files, hash, pixels }) {
    if (!exercises.has(folder)) exercises.set(folder, loadExercise(folder, files))
    await exercises.get(folder)
    ;(await module).FS.writeFile('/picture', new Uint8Array(pixels))
    return JSON.parse(await ask('diagnose', ['string', 'string', 'string'], ['/' + folder, hash, '/picture']))
  }
}

addEventListener('message', async ({ data }) => {
  try {
    postMessage({ id: data.id, ...await calls[data.call](data) })
  } catch (error) {
    postMessage({ id: data.id, error: error.message })
  }
})
