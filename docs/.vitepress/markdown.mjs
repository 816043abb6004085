// What makes a page of docs/ a page of the site: a page's first picture of a stage becomes one that can be touched, commands become
// buttons, figures are drawn inline, and links lead to where the site keeps what they name.
import fs from 'node:fs'
import path from 'node:path'
import { root, stages } from './stages.mjs'
import { problemOf } from './translations.mjs'

const escaped = (text) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;')
const stageOfGolden = (file) => {
  const [, folder, stem] = file.match(/^tests\/golden\/(\w+)\/(\w+)\.png$/) ?? []
  return stages.find((stage) => stage.folder === folder && stage.stem === stem)
}

export const base = process.env.RELIEF_BOOK_BASE ?? '/'

// Files that pages link to and that are not pages: the site has copies of them.
export const linkedFiles = new Set()
export const copyOf = (file) => 'source/' + file + (/\.(png|svg|glb|html|json)$/.test(file) ? '' : '.txt')

// A page's address on the site, from its file in the repository.
export const pageOf = (file) =>
  file === 'docs/README.md' ? 'index.md'
    : file === 'docs/zh/README.md' ? 'zh/index.md'
      : file === 'README.md' ? 'project.md'
        : file.startsWith('docs/') ? file.slice(5).replace(/(^|\/)README\.md$/, '$1index.md')
          : file.replace(/(^|\/)README\.md$/, '$1index.md')

// What config.mjs leaves out is a file like any other.
const isPage = (file) => file.endsWith('.md') && !/^(samples|tests)\//.test(file) && fs.existsSync(path.join(root, file))

function resolved(env, href) {
  const [target, hash = ''] = href.split(/(?=#)/)
  const file = path.posix.normalize(path.posix.join(path.posix.dirname(env.file), target))
  if (isPage(file)) return '/' + pageOf(file) + hash
  if (fs.existsSync(path.join(root, file)) && fs.statSync(path.join(root, file)).isDirectory()) {
    return isPage(file + '/README.md') ? '/' + pageOf(file + '/README.md') + hash : null
  }
  if (!fs.existsSync(path.join(root, file))) return href
  linkedFiles.add(file)
  return '/' + copyOf(file)
}

// `./relief render 1.08 --set lightYaw=90 --show depth` as what a player can be told; null where it is another program's.
function commandOf(line) {
  const words = line.trim().split(/\s+/)
  if (words[0] !== './relief' || words[1] !== 'render') return null
  const command = { stage: '', settings: [], view: '' }
  for (let i = 2; i < words.length; ++i) {
    if (words[i] === '--set') command.settings.push(words[++i])
    else if (words[i] === '--show' && !words[i + 1].includes('@')) command.view = words[++i]
    else if (words[i] === '-o' || words[i] === '--size') ++i
    else if (words[i].startsWith('-') || command.stage !== '') return null
    else command.stage = words[i]
  }
  const stage = stages.find((s) => command.stage === s.id || command.stage === s.stem || command.stage === s.stem.slice(3) ||
    command.stage === s.id.replace('.0', '.'))
  return stage === undefined ? null : { ...command, stage: stage.id }
}

// A figure's text, without its own style: the site's follows its light and dark.
function figure(file, alt) {
  const svg = fs.readFileSync(path.join(root, file), 'utf8')
  return svg.replace(/<\?xml[^>]*>/, '').replace(/<style>[\s\S]*?<\/style>/, '')
    .replace(/<svg[^>]*>/, (head) => head.replace(/ (role|aria-[a-z]+)="[^"]*"/g, '').replace('<svg', `<svg role="img" aria-label="${escaped(alt)}"`))
}

export default function relief(md) {
  // VitePress hands the page's file over with each text.
  md.core.ruler.before('normalize', 'relief-file', (state) => {
    state.env.file = path.posix.relative(root, state.env.realPath ?? state.env.path)
  })

  md.core.ruler.push('relief-links', (state) => {
    const tokens = state.tokens.flatMap((token) => token.children ?? [])
    for (const token of tokens) {
      if (token.type !== 'link_open') continue
      const href = token.attrGet('href')
      if (/^([a-z]+:|#|\/)/.test(href)) continue
      const target = resolved(state.env, decodeURI(href))
      if (target === null) token.attrs = [['class', 'no-page']]
      else token.attrSet('href', target)
      if (target?.startsWith('/source/')) token.attrSet('target', '_blank')
    }
  })

  // A translation that is behind says so above its text.
  md.core.ruler.push('relief-behind', (state) => {
    const page = state.env.file.match(/^docs\/zh\/(.*)$/)?.[1]
    if (page === undefined || problemOf(page) === '') return
    const token = new state.Token('html_block', '', 0)
    token.content = '<p class="behind">此译文落后于英文页面。</p>\n'
    state.tokens.splice(state.tokens.findIndex(({ type }) => type === 'heading_close') + 1, 0, token)
  })

  // The same for what is written as HTML.
  const html = (rule) => (tokens, index, options, env, self) => rule(tokens, index, options, env, self)
    .replace(/href="([^"]+)"/g, (all, href) => {
      const target = /^([a-z]+:|#|\/)/.test(href) ? href : resolved(env, href)
      return target === null ? '' : `href="${target.startsWith('/') ? base + target.slice(1).replace(/\.md(?=#|$)/, '.html') : target}"`
    })
    .replace(/src="(?![a-z]+:|\/|\.)/g, 'src="./')
  md.renderer.rules.html_block = html(md.renderer.rules.html_block)
  md.renderer.rules.html_inline = html(md.renderer.rules.html_inline)

  // A picture alone in its paragraph stands for itself: what takes its place holds blocks.
  md.core.ruler.push('relief-pictures', (state) => {
    state.tokens.forEach((token, i) => {
      const isPicture = token.type === 'inline' && token.children.length === 1 && token.children[0].type === 'image'
      if (isPicture && state.tokens[i - 1]?.type === 'paragraph_open') {
        state.tokens[i - 1].hidden = state.tokens[i + 1].hidden = true
      }
    })
  })

  const image = md.renderer.rules.image
  md.renderer.rules.image = (tokens, index, options, env, self) => {
    const token = tokens[index]
    const src = token.attrGet('src')
    if (/^[a-z]+:/.test(src)) return image(tokens, index, options, env, self)
    const file = path.posix.normalize(path.posix.join(path.posix.dirname(env.file), decodeURI(src)))
    const alt = token.content
    const stage = stageOfGolden(file)
    const standsAlone = tokens.length === 1
    if (stage !== undefined && standsAlone && env.player === undefined) {
      env.player = stage
      const before = stage.before === null ? '' : ` before="${stage.before}"`
      return `<StagePlayer stage="${stage.id}"${before} hash="${stage.hash}" source="${stage.folder}/${stage.stem}.cpp">` +
        image(tokens, index, options, env, self) + '</StagePlayer>'
    }
    if (file.endsWith('.svg')) {
      const name = path.basename(file, '.svg')
      const drawn = `<span class="figure" v-pre>${figure(file, alt)}</span>`
      return name.startsWith('start_') ? `<LiveFigure name="${name}" alt="${escaped(alt)}">${drawn}</LiveFigure>` : drawn
    }
    return image(tokens, index, options, env, self)
  }

  // Before "What to try": the stage's whole source, its new lines highlighted.
  md.core.ruler.push('relief-source', (state) => {
    const stage = stages.find(({ folder, stem }) => state.env.file.endsWith(`/${folder}/${stem}.md`))
    const at = state.tokens.findIndex((token, i) => token.type === 'heading_open' && ['What to try', '试一试'].includes(state.tokens[i + 1].content))
    if (stage === undefined || at < 0) return
    const code = fs.readFileSync(path.join(root, 'samples', stage.folder, stage.stem + '.cpp'), 'utf8')
    const news = code.split('\n').flatMap((line, i) => line.endsWith('// new') ? [i + 1] : [])
    const token = new state.Token('fence', 'code', 0)
    token.content = code.replace(/ +\/\/ new$/gm, '')
    token.info = `cpp:line-numbers{${news.join(',')}}`
    token.meta = { source: `${stage.folder}/${stage.stem}.cpp` }
    state.tokens.splice(at, 0, token)
  })

  // Indented code is as it stands, braces too.
  const block = md.renderer.rules.code_block
  md.renderer.rules.code_block = (...all) => block(...all).replace('<pre', '<pre v-pre')

  const fence = md.renderer.rules.fence
  md.renderer.rules.fence = (tokens, index, options, env, self) => {
    const html = fence(tokens, index, options, env, self)
    const token = tokens[index]
    if (token.meta?.source) return `<details class="details source"><summary><code>${token.meta.source}</code></summary>${html}</details>`
    if (token.info !== '' || env.player === undefined) return html
    const commands = token.content.split('\n').map((line) => ({ line: line.trim(), command: commandOf(line) }))
      .filter(({ command }) => command !== null && [env.player.id, env.player.before].includes(command.stage))
    if (commands.length === 0) return html
    return html + `<TryCommands :commands='${JSON.stringify(commands.map(({ line, command }) => ({ line, ...command })))
      .replace(/'/g, '&#39;')}' />`
  }
}
