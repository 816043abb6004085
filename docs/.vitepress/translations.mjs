// Each Chinese page, docs/zh/PAGE, says in its front matter which state of docs/PAGE it follows: a commit, and the name
// that git gives the file's content. A page whose English has changed since is behind: the site says so, and CI fails.
//
//   node translations.mjs               names the pages that are behind or say nothing; exit code 1 if there are any
//   node translations.mjs PAGE...       these follow what is there now, as of the last commit
import crypto from 'node:crypto'
import fs from 'node:fs'
import path from 'node:path'
import { execFileSync } from 'node:child_process'
import { pathToFileURL } from 'node:url'
import { root } from './stages.mjs'

const docs = path.join(root, 'docs')

// As `git hash-object` does.
const nameOf = (text) => crypto.createHash('sha1').update(`blob ${Buffer.byteLength(text)}\0`).update(text).digest('hex')
const english = (page) => fs.readFileSync(path.join(docs, page), 'utf8')
const follows = (text) => text.match(/^---\nenglish: ([0-9a-f]{7,40}) ([0-9a-f]{40})\n---\n/)

// `page`: below docs/zh. Empty: it is not behind.
export function problemOf(page) {
  const said = follows(fs.readFileSync(path.join(docs, 'zh', page), 'utf8'))
  if (said === null) return 'its front matter does not say which English page it follows: `english: COMMIT CONTENT`'
  if (!fs.existsSync(path.join(docs, page))) return 'there is no English page of this name'
  return said[2] === nameOf(english(page)) ? '' : `the English page has changed since ${said[1]}`
}

const pages = () => fs.existsSync(path.join(docs, 'zh'))
  ? fs.readdirSync(path.join(docs, 'zh'), { recursive: true }).filter((file) => file.endsWith('.md')).sort() : []

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const named = process.argv.slice(2).map((page) => page.replace(/^.*docs\/zh\//, ''))
  for (const page of named) {
    const file = path.join(docs, 'zh', page)
    const commit = execFileSync('git', ['-C', root, 'log', '-1', '--format=%h', '--', 'docs/' + page], { encoding: 'utf8' }).trim()
    const text = fs.readFileSync(file, 'utf8').replace(/^---\n[\s\S]*?\n---\n/, '')
    fs.writeFileSync(file, `---\nenglish: ${commit} ${nameOf(english(page))}\n---\n` + text)
  }
  const behind = pages().map((page) => [page, problemOf(page)]).filter(([, problem]) => problem !== '')
  for (const [page, problem] of named.length > 0 ? [] : behind) console.log(`docs/zh/${page}: ${problem}`)
  if (named.length === 0) {
    console.log(`${pages().length} Chinese pages, ${behind.length} behind`)
    process.exit(behind.length === 0 ? 0 : 1)
  }
}
