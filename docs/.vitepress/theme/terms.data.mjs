// The index: each term of the glossary, with the pages that lead to it, by language.
import fs from 'node:fs'
import path from 'node:path'
import { pageOf } from '../markdown.mjs'
import { root } from '../stages.mjs'

export default {
  load() {
    const index = { en: {}, zh: {} }
    for (const file of fs.readdirSync(path.join(root, 'docs'), { recursive: true }).sort()) {
      if (!file.endsWith('.md') || /node_modules|glossary\.md$/.test(file)) continue
      const text = fs.readFileSync(path.join(root, 'docs', file), 'utf8')
      const title = text.match(/^# (.*)/m)?.[1] ?? file
      const terms = index[file.startsWith('zh/') ? 'zh' : 'en']
      for (const [, term, anchor] of text.matchAll(/\[([^\]]+)\]\([./]*glossary\.md#([^)\s]+)\)/g)) {
        terms[anchor] ??= { term, anchor, pages: [] }
        if (!terms[anchor].pages.some((page) => page.title === title)) terms[anchor].pages.push({ title, address: '/' + pageOf('docs/' + file).replace(/\.md$/, '.html') })
      }
    }
    const sorted = (terms, language) => Object.values(terms).sort((a, b) => a.term.localeCompare(b.term, language))
    return { en: sorted(index.en, 'en'), zh: sorted(index.zh, 'zh-Hans') }
  }
}
