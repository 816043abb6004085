// The stages of the book, from the files that the programs are built from.
import fs from 'node:fs'
import path from 'node:path'
import { fileURLToPath } from 'node:url'

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..')
const read = (file) => fs.readFileSync(path.join(root, file), 'utf8')

// [{id: '1.08', stem: '08_along_v', folder: 'bumpiness', hash, before: '1.07' or null}], in order.
// `before`: the stage before it in the same chapter.
export const stages = (() => {
  const folders = [...read('samples/CMakeLists.txt').matchAll(/^add_tutorial\((\d) (\w+)/gm)].map((m) => m[2])
  const list = read('tests/golden/hashes.txt').trim().split('\n').map((line) => {
    const [hash, id, stem] = line.trim().split(/\s+/)
    const folder = folders[Number(id[0])]
    return { id, stem, folder, hash, before: null }
  })
  list.forEach((stage, i) => {
    if (i > 0 && list[i - 1].folder === stage.folder) stage.before = list[i - 1].id
  })
  return list
})()

export const chapters = (() => {
  const titles = {
    basics: ['0 The ground', '0 基础'],
    bumpiness: ['1 Bumpiness', '1 凹凸'],
    bumpy_surfaces: ['2 Bumpy surfaces', '2 凹凸表面'],
    normal_maps: ['3 Normal maps', '3 法线贴图'],
    triplanar: ['4 Triplanar', '4 三平面'],
    beyond: ['5 Beyond', '5 更进一步']
  }
  return Object.entries(titles).map(([folder, [en, zh]]) => ({
    folder, en, zh, stages: stages.filter((stage) => stage.folder === folder)
  }))
})()
