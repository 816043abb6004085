// The worker of a player: it holds the stage, the stage before it for the divider, and, when a pixel is asked about, the
// stage that tells its life. Messages are {id, call, ...}; answers {id, ...} or {id, error}.
const folder = new URL('.', import.meta.url)
const files = new Map()  // by name: their bytes
const players = new Map()  // by "module stage": promises

function fileOf(name) {
  if (!files.has(name)) {
    files.set(name, fetch(new URL('assets/' + name, folder)).then((response) => {
      if (!response.ok) throw new Error(`${name}: ${response.status}; it cannot be loaded`)
      return response.arrayBuffer()
    }))
  }
  return files.get(name)
}

class Player {
  constructor(module) { this.module = module }

  call(name, types = [], values = [], result = 'string') {
    const answer = this.module.ccall('relief_' + name, result, types, values)
    if (typeof answer === 'string' && answer.startsWith('error: ')) throw new Error(answer.slice(7))
    return answer
  }

  static async open(createModule, stage, options = {}) {
    const player = new Player(await createModule(options))
    player.description = JSON.parse(player.call('open', ['string'], [stage]))
    player.module.FS.mkdir('/assets')
    const bytes = await Promise.all(player.description.files.map(fileOf))
    player.description.files.forEach((name, i) => player.module.FS.writeFile('/assets/' + name, new Uint8Array(bytes[i])))
    player.views = JSON.parse(player.call('load'))
    return player
  }

  // What the reader chose; of settings that are another stage's, nothing. `moves` begin where `camera` stands.
  apply({ settings = [], camera = null, moves = [] }) {
    this.module.ccall('relief_reset', null, [], [])
    const names = new Set(this.description.properties.map((property) => property.name))
    for (const setting of settings) {
      if (names.has(setting.split('=')[0])) this.call('set', ['string'], [setting])
    }
    if (camera !== null) this.call('look', ['string'], [camera])
    for (const { move, values } of moves) this.module.ccall('relief_' + move, null, values.map(() => 'number'), values)
    return camera === null && moves.length === 0 ? null : this.call('camera')
  }

  draw(look, width, height) {
    const camera = this.apply(look)
    this.call('render', ['number', 'number', 'string'], [width, height, look.view ?? ''])
    const begin = this.module.ccall('relief_pixels', 'number', [], [])
    return { camera, pixels: this.module.HEAPU8.slice(begin, begin + 4 * width * height).buffer }
  }
}

function playerOf(program, stage) {
  const key = program + ' ' + stage
  if (!players.has(key)) {
    players.set(key, import(new URL(program + '.mjs', folder)).then(({ default: create }) => Player.open(create, stage)))
  }
  return players.get(key)
}

const calls = {
  // A stage that was compiled in the page takes the place of the last one.
  async edit({ stage, wasm }) {
    const { default: create } = await import(new URL('relief_web.mjs', folder))
    players.set('edited ' + stage, Player.open(create, stage, { wasmBinary: wasm }))
    const player = await playerOf('edited', stage)
    return { ...player.description, views: player.views }
  },
  async open({ program, stage }) {
    const player = await playerOf(program, stage)
    return { ...player.description, views: player.views }
  },
  async draw({ program, stage, look, width, height }) {
    const player = await playerOf(program, stage)
    const begin = performance.now()
    const drawn = player.draw(look, width, height)
    return { ...drawn, width, height, milliseconds: performance.now() - begin }
  },
  async hash({ program, stage }) {
    return { hash: (await playerOf(program, stage)).call('hash') }
  },
  async life({ stage, look, x, y, width, height, source }) {
    const player = await playerOf('relief_traced', stage)
    player.apply(look)
    return { page: player.call('trace', ['number', 'number', 'number', 'number', 'string'], [x, y, width, height, source]) }
  }
}

addEventListener('message', async ({ data }) => {
  try {
    const answer = await calls[data.call](data)
    postMessage({ id: data.id, ...answer }, answer.pixels ? [answer.pixels] : [])
  } catch (error) {
    postMessage({ id: data.id, error: error.message })
  }
})
