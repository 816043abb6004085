// Tries the book in Chromium, as a reader does: node run.mjs FOLDER [PART...]. Every page: no error, its links and pictures
// there, axe. Every stage: the hash, the divider, a slider, a view, a command of the text. One stage: its pixels, an edit.
// The search in both languages. Prints a line a part, and what went wrong; exit code 1 where anything did.
import fs from 'node:fs'
import path from 'node:path'
import { execFileSync } from 'node:child_process'
import { createRequire } from 'node:module'
import { fileURLToPath } from 'node:url'
import { chromium } from 'playwright-core'
import { serve } from '../serve.mjs'
import { exercises } from '../exercises.mjs'
import { stages } from '../stages.mjs'
import { searches } from './searches.mjs'

const folder = path.resolve(process.argv[2])
const wanted = process.argv.slice(3)
const failures = []
const check = (condition, words) => { if (!condition) failures.push(words) }

const { server, address } = await serve(folder)
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
const context = await browser.newContext({ viewport: { width: 1280, height: 900 } })
const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8')

async function pageOf(name, options = {}) {
  const page = await (options.context ?? context).newPage()
  page.on('console', (message) => { if (message.type() === 'error') failures.push(`${name}: console: ${message.text()}`) })
  page.on('pageerror', (error) => failures.push(`${name}: ${error.message}`))
  page.on('response', (response) => { if (response.status() >= 400) failures.push(`${name}: ${response.status()} ${response.url()}`) })
  await page.goto(`${address}/${name}`)
  return page
}

const pages = fs.readdirSync(folder, { recursive: true })
  .filter((file) => file.endsWith('.html') && !file.startsWith('source') && file !== '404.html').sort()
const isThere = (name) => pages.includes(name)
const languages = ['', 'zh/'].filter((language) => isThere(language + 'index.html'))
const stagePages = languages.flatMap((language) => stages.map((stage) => ({ stage, language, name: `${language}${stage.folder}/${stage.stem}.html` })))
  .filter(({ name, language }) => language === '' || isThere(name))

const ready = (page, attribute = 'ready') => page.waitForSelector(`.player[data-${attribute}]`, { timeout: 60000 })
const pixels = (page) => page.evaluate(() => {
  const canvas = document.querySelector('.player canvas')
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data
  let sum = 0
  for (let i = 0; i < data.length; ++i) sum = (sum * 31 + data[i]) >>> 0
  return `${canvas.width}x${canvas.height} ${sum}`
})
// Until a picture of the small size is drawn that differs from that one.
const changed = (page, before) => page.waitForFunction((before) => {
  const canvas = document.querySelector('.player canvas')
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data
  let sum = 0
  for (let i = 0; i < data.length; ++i) sum = (sum * 31 + data[i]) >>> 0
  return `${canvas.width}x${canvas.height} ${sum}` !== before
}, before, { timeout: 30000 })

const parts = {
  async translations() {
    const said = execFileSync('node', [fileURLToPath(new URL('../translations.mjs', import.meta.url))], { encoding: 'utf8' }).trim()
    return said
  },

  async pages() {
    const anchors = new Map()  // texts of pages, by their files
    for (const name of pages) {
      const page = await pageOf(name)
      const broken = await page.evaluate(() => [...document.images].filter((image) => image.loading !== 'lazy' && image.complete && image.naturalWidth === 0).map((image) => image.src))
      check(broken.length === 0, `${name}: pictures that are not there: ${broken}`)
      const targets = await page.evaluate(() => [...document.querySelectorAll('.vp-doc a[href]')].map((a) => a.href))
      for (const target of new Set(targets)) {
        if (!target.startsWith(address)) continue
        const file = decodeURIComponent(new URL(target).pathname).slice(1).replace(/(^|\/)$/, '$1index.html')
        const isFile = fs.existsSync(path.join(folder, file))
        check(isFile, `${name}: a link leads nowhere: ${file}`)
        const anchor = decodeURIComponent(new URL(target).hash.slice(1))
        if (isFile && anchor !== '') {
          if (!anchors.has(file)) anchors.set(file, fs.readFileSync(path.join(folder, file), 'utf8'))
          check(anchors.get(file).includes(`id="${anchor}"`), `${name}: there is no #${anchor} in ${file}`)
        }
      }
      check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name}: is wider than its window`)
      await page.close()
    }
    return `${pages.length} pages`
  },

  async small() {
    const narrow = await browser.newContext({ viewport: { width: 390, height: 844 } })
    for (const name of pages) {
      const page = await pageOf(name, { context: narrow })
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)
      check(wide <= 0, `${name}: ${wide} pixels wider than a telephone's window`)
      await page.close()
    }
    await narrow.close()
    return `${pages.length} pages at 390 pixels`
  },

  async stages() {
    let slowest = 0, late = 0
    for (const { stage, name } of stagePages) {
      const page = await pageOf(name)
      const begin = Date.now()
      try {
        await ready(page)
        slowest = Math.max(slowest, Date.now() - begin)
        if (Date.now() - begin > 2000) ++late
        await ready(page, 'hash')
        const hash = await page.getAttribute('.player', 'data-hash')
        check(hash === stage.hash, `${name}: hash ${hash}, should be ${stage.hash}`)

        const rest = await pixels(page)
        const divider = page.locator('.player .compare input')
        if (await divider.count() > 0) {
          await divider.fill('100')
          await changed(page, rest).catch(() => check(stage.id === '3.03', `${name}: the divider changes nothing`))
          await divider.fill('0')
        }
        const view = page.locator('.player .inside select')
        const before = await pixels(page)
        await view.selectOption('depth').catch(() => failures.push(`${name}: has no view of depth`))
        await changed(page, before)
        await view.selectOption('')
        await page.click('.player .reset')
      } catch (error) {
        failures.push(`${name}: ${error.message.split('\n')[0]}`)
      }
      await page.close()
    }
    return `${stagePages.length} stages; the slowest first picture after ${slowest} ms, ${late} after more than 2 s`
  },

  async properties() {
    let count = 0
    for (const { stage, name } of stagePages.filter(({ language }) => language === '')) {
      const page = await pageOf(name)
      try {
        await ready(page, 'hash')
        if (await page.locator('.player .properties').count() > 0) {
          await page.evaluate(() => { document.querySelector('.player .properties').open = true })
          let changes = 0
          for (const slider of await page.locator('.player .properties input[type=range]').all()) {
            const before = await pixels(page)
            await slider.evaluate((input) => {
              const [low, high, at] = [Number(input.min), Number(input.max), Number(input.value)]
              input.value = Math.abs(high - at) > Math.abs(at - low) ? high - (high - at) / 3 : low + (at - low) / 3
              input.dispatchEvent(new Event('input', { bubbles: true }))
            })
            ++count
            await page.waitForTimeout(60)
            if (await changed(page, before).then(() => true, () => false)) { ++changes; break }
          }
          const hasSliders = await page.locator('.player .properties input[type=range]').count() > 0
          check(!hasSliders || changes > 0, `${name}: no slider changes the picture`)
        }
        check(await page.locator('.player .wrong').count() === 0, `${name}: a property is refused`)
      } catch (error) {
        failures.push(`${name}: ${error.message.split('\n')[0]}`)
      }
      await page.close()
    }
    return `${count} sliders were moved`
  },

  async commands() {
    let count = 0
    for (const { name } of stagePages.filter(({ language }) => language === '')) {
      const page = await pageOf(name)
      await ready(page, 'hash')
      await page.evaluate(() => { for (const answer of document.querySelectorAll('.vp-doc details')) answer.open = true })
      for (const button of await page.locator('.try button').all()) {
        await button.click()
        await page.waitForFunction((b) => b.getAttribute('aria-pressed') === 'true', await button.elementHandle(), { timeout: 30000 })
          .catch(() => failures.push(`${name}: ${button} is not shown`))
        const refused = await page.locator('.player .wrong').allTextContents()
        check(refused.length === 0, `${name}: ${await button.textContent()}: ${refused}`)
        ++count
      }
      await page.close()
    }
    return `${count} commands of the text`
  },

  async speed() {
    const words = []
    for (const id of ['1.01', '1.12', '2.01', '4.05']) {
      const stage = stages.find((one) => one.id === id)
      const page = await pageOf(`${stage.folder}/${stage.stem}.html`)
      await ready(page, 'hash')
      const times = []
      await page.focus('.player canvas')
      for (let i = 0; i < 20; ++i) {
        await page.keyboard.press(i % 2 ? 'ArrowLeft' : 'ArrowRight')
        await page.waitForTimeout(20)
        times.push(Number(await page.getAttribute('.player', 'data-milliseconds')))
      }
      times.sort((a, b) => a - b)
      words.push(`${id} ${times[10].toFixed(0)} ms`)
      await page.close()
    }
    return `median of a picture of 480 x 270: ${words.join(', ')}`
  },

  async pixel() {
    const stage = stages.find((one) => one.id === '1.12')
    const page = await pageOf(`${stage.folder}/${stage.stem}.html`)
    await ready(page, 'hash')
    await page.click('.player .pixel')
    await page.focus('.player canvas')
    await page.keyboard.press('ArrowRight')
    await page.keyboard.press('Enter')
    const frame = await (await page.waitForSelector('.life iframe', { timeout: 60000 })).contentFrame()
    const text = await frame.textContent('main')
    for (const name of ['UnpackScaleNormal', 'texel', 'tangentSpaceNormal', 'bumpScale'].slice(0, 2)) check(text.includes(name), `the life of a pixel does not speak of ${name}`)
    const stored = await frame.textContent('aside')
    check(/stored: #[0-9a-f]{6}, alpha ff/.test(stored), `the life of a pixel does not end at its bytes: ${stored}`)
    await page.close()
    return 'told'
  },

  async edit() {
    const stage = stages.find((one) => one.id === '1.12')
    const page = await pageOf(`${stage.folder}/${stage.stem}.html`)
    await ready(page, 'hash')
    const times = []
    const step = async (what, selector) => {
      const begin = Date.now()
      await page.waitForSelector(selector, { timeout: 120000 })
      times.push(`${what} ${((Date.now() - begin) / 1000).toFixed(1)} s`)
    }
    const compile = async () => {
      await page.evaluate(() => { delete document.querySelector('.player').dataset.edited })
      await page.click('.editor .compile')
    }
    await page.click('.player .edit')
    await step('loaded and compiled as it is', '.player[data-edited]')
    check(await page.getAttribute('.player', 'data-edited') === stage.hash, `the same source, compiled in the page, has not the same hash`)
    const text = fs.readFileSync(path.join(folder, `source/samples/${stage.folder}/${stage.stem}.cpp.txt`), 'utf8')
    const write = async (words) => {
      await page.click('.cm-content')
      await page.keyboard.press('Control+a')
      await page.keyboard.insertText(words)
    }
    const flat = text.replace('i.normal = i.normal.xzy();', 'i.normal = float3(0, 1, 0);')
    check(flat !== text, 'the edit that is tried is none')
    await write(flat)
    await compile()
    await step('an edit', '.player[data-edited]')
    check(await page.getAttribute('.player', 'data-edited') !== stage.hash, 'an edit changes nothing')
    await write(flat.replace('float3(0, 1, 0);', 'float3(0, 1, 0)'))
    await compile()
    await step('an error', '.editor .errors li')
    check(/12_bump_scale.cpp:\d+.*expected ';'/.test(await page.textContent('.editor .errors')), 'the error is not told')
    await page.close()
    return times.join(', ')
  },

  async exercise() {
    const stage = stages.find((one) => one.id === '1.08')
    const page = await pageOf(`${stage.folder}/${stage.stem}.html`)
    await ready(page, 'hash')
    await page.click('.player .edit')
    await page.waitForSelector('.player[data-edited]', { timeout: 120000 })
    const verdict = async (words) => {
      await page.waitForFunction((words) => document.querySelector('.editor .verdict')?.textContent.includes(words), words, { timeout: 60000 })
        .catch(async () => failures.push(`the exercise does not say "${words}": ${await page.locator('.editor .verdict').allTextContents()}`))
    }
    const fill = async (gap) => {
      const { text } = exercises.find(({ id }) => id === '1.08a')
      const filled = text.replace(/(\/\/ your turn.*\n)[\s\S]*?(\n *\/\/ end of your turn)/, (all, begin, end) => begin + gap + end)
      check(filled !== text, 'the gap of 1.08a is not found')
      await page.click('.cm-content')
      await page.keyboard.press('Control+a')
      await page.keyboard.insertText(filled)
      await page.click('.editor .compile')
    }
    await page.selectOption('.editor .exercise select', '1.08a')
    await verdict('as it was given')
    const answer = fs.readFileSync(fileURLToPath(new URL('../../../samples/exercises/1.08a_along_v/answer/answer.cpp', import.meta.url)), 'utf8')
      .match(/\/\/ your turn.*\n([\s\S]*?)\n *\/\/ end of your turn/)[1]
    await fill(answer.replace('(v1 - v2)', '(v2 - v1)'))
    await verdict('Your v slope has the wrong sign: bumps are dents. Your picture is, bit for bit, what that gives. See 1.08.')
    await fill(answer.replace('(v1 - v2)', '(v2 - v1) * 1.03f'))
    await verdict('Your picture is nearest to what that gives, of all known mistakes')
    await fill(answer)
    await verdict('Solved, bit for bit.')
    await fill(answer.replace('(v1 - v2)', '(v1 - v2) * 0.9f'))
    await verdict('none of the')
    await page.close()
    return 'a mistake, the answer, and what is neither'
  },

  // A map with its green upside down, in both languages; the cured one is sound; a text is no picture.
  async doctor() {
    for (const language of languages) {
      const page = await pageOf(`${language}doctor.html`)
      const bytes = await page.evaluate(() => new Promise((resolve) => {
        const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 64 }), context = canvas.getContext('2d')
        const picture = context.createImageData(64, 64)
        for (let i = 0; i < 64 * 64; ++i) {
          const x = i % 64, y = Math.floor(i / 64), wave = Math.sin((x + 2 * y) * 0.09817477)
          const u = 0.4 * Math.sin(3 * x * 0.09817477 + 1) + 0.15 * wave, v = 0.3 * wave, length = Math.hypot(u, v, 1)
          picture.data.set([u, v, 1].map((n) => Math.round((n / length * 0.5 + 0.5) * 255)).concat(255), 4 * i)
        }
        context.putImageData(picture, 0, 0)
        canvas.toBlob(async (blob) => resolve([...new Uint8Array(await blob.arrayBuffer())]), 'image/png')
      }))
      const examine = async (name, buffer, words) => {
        await page.setInputFiles('.map-doctor input[name=map]', { name, mimeType: 'image/png', buffer })
        await page.waitForFunction((words) => document.querySelector('.map-doctor')?.textContent.includes(words), words, { timeout: 30000 })
          .catch(async () => failures.push(`${language}: the doctor does not say "${words}": ${await page.textContent('.map-doctor')}`))
      }
      await examine('bumps.png', Buffer.from(bytes), 'fault: green is upside down')
      const size = await page.locator('.map-doctor figure img').evaluate(async (image) => {
        await image.decode()
        return `${image.naturalWidth}x${image.naturalHeight}`
      })
      check(size === '256x64', `the evidence has ${size}`)
      const link = page.locator('.map-doctor a[download="bumps-cured.png"]')
      const cured = await link.evaluate(async (a) => [...new Uint8Array(await (await fetch(a.href)).arrayBuffer())])
      await examine('cured.png', Buffer.from(cured), 'no fault was found')
      await examine('text.png', Buffer.from('no picture'), 'text.png')
      check(await page.locator('.map-doctor figure').count() === 0, 'a file that is no picture has evidence')
      await page.close()
    }
    return 'a fault, the cured map, no picture'
  },

  async share() {
    const stage = stages.find((one) => one.id === '1.12')
    const name = `${stage.folder}/${stage.stem}.html`
    const page = await pageOf(name)
    await ready(page, 'hash')
    await page.focus('.player canvas')
    await page.keyboard.press('ArrowRight')
    await page.evaluate(() => { document.querySelector('.player .properties').open = true })
    await page.locator('.player .properties input[type=range]').first().fill('0')
    await page.waitForTimeout(1500)
    await page.click('.player .share')
    const picture = await pixels(page)
    const other = await pageOf(name + new URL(page.url()).hash)
    await ready(other, 'hash')
    await other.waitForTimeout(1500)
    check(await pixels(other) === picture, 'the link to a picture leads to another one')
    await page.close()
    await other.close()
    return 'the same picture'
  },

  async search() {
    let count = 0
    for (const [language, words] of Object.entries(searches)) {
      if (!isThere(language + 'index.html')) continue
      const page = await pageOf(language + 'index.html')
      for (const [word, target] of words) {
        await page.keyboard.press('Control+k')
        await page.fill('.VPLocalSearchBox input', word)
        await page.waitForSelector('.VPLocalSearchBox .result', { timeout: 10000 }).catch(() => {})
        await page.waitForTimeout(300)
        const found = await page.evaluate(() => [...document.querySelectorAll('.VPLocalSearchBox .result')].map((a) => a.getAttribute('href')))
        check(found.some((href) => href.includes(target)), `search for ${word}: no ${target} among ${found.slice(0, 5)}`)
        await page.keyboard.press('Escape')
        ++count
      }
      await page.close()
    }
    return `${count} words`
  },

  async accessibility() {
    const names = pages.filter((name) => /^(zh\/)?(index|glossary|start\/.*|bumpiness\/(08|12|21).*|triplanar\/11.*|beyond\/17.*)\.html$/.test(name))
    for (const name of names) {
      for (const scheme of ['light', 'dark']) {
        const themed = await browser.newContext({ viewport: { width: 1280, height: 900 }, colorScheme: scheme, reducedMotion: 'reduce' })
        const page = await pageOf(name, { context: themed })
        if (await page.locator('.player').count() > 0) await ready(page, 'hash')
        await page.evaluate(axe)
        const { violations } = await page.evaluate(() => axe.run(document, { resultTypes: ['violations'] }))
        for (const { id, impact, nodes } of violations) {
          if (impact === 'serious' || impact === 'critical') failures.push(`${name}, ${scheme}: ${id} (${impact}): ${nodes.slice(0, 3).map((node) => node.target).join(' ')}`)
        }
        await themed.close()
      }
    }
    return `${names.length} pages, light and dark`
  },

  async script() {
    const plain = await browser.newContext({ javaScriptEnabled: false })
    for (const { name } of stagePages) {
      const page = await plain.newPage()
      await page.goto(`${address}/${name}`)
      check(await page.locator('.player img').count() === 1, `${name}: no picture without script`)
      check((await page.textContent('.vp-doc')).length > 1000, `${name}: no text without script`)
      await page.close()
    }
    await plain.close()
    return `${stagePages.length} stages are readable without`
  }
}

for (const [name, part] of Object.entries(parts)) {
  if (wanted.length > 0 && !wanted.includes(name)) continue
  const begin = Date.now(), before = failures.length
  let said = ''
  try {
    said = await part()
  } catch (error) {
    failures.push(`${name}: ${error.stack}`)
  }
  console.log(`${failures.length === before ? 'passed' : 'FAILED'} ${name}: ${said} (${((Date.now() - begin) / 1000).toFixed(0)} s)`)
  for (const failure of failures.slice(before, before + 40)) console.log('    ' + failure)
}
await browser.close()
server.close()
process.exit(failures.length === 0 ? 0 : 1)
