// The exercises for the book's pages, from samples/exercises: each one's file as a learner gets it, and what is known of its
// pictures by their hashes. [{id, title, stage, kind, text, goal, known: {hash: {isRight, words}}}], in order.
import fs from 'node:fs'
import path from 'node:path'
import { root } from './stages.mjs'

const folder = path.join(root, 'samples/exercises')

// The names and sentences of a section: "- `sign` Your v slope has the wrong sign. See 1.08."
function listOf(page, section) {
  const text = page.split(/^## /m).find((part) => part.startsWith(section + '\n')) ?? ''
  return new Map([...text.matchAll(/^- `([^`]+)` ?(.*)$/gm)].map(([, name, words]) => [name, words]))
}

export const exercises = fs.readdirSync(folder).filter((name) => /^\d\.\d\d[a-z]_/.test(name)).sort().map((name) => {
  const read = (file) => fs.readFileSync(path.join(folder, name, file), 'utf8')
  const page = read('exercise.md')
  const [, id, title] = page.match(/^# (\S+) (.*)/)
  const [, stage, kind] = page.match(/^Stage (\S+) · (\w+)/m)
  const mistakes = listOf(page, 'Mistakes'), right = listOf(page, 'Also right')
  const known = {}
  for (const [, hash, variant] of read('catalogue.txt').matchAll(/^([0-9a-f]{16}) (\S+)/gm)) {
    const isRight = variant === 'answer' || right.has(variant)
    known[hash] = { isRight, words: isRight || variant === 'start' ? '' : variant.split('+').map((one) => mistakes.get(one)).join(' ') }
  }
  return { id, title, stage, kind, text: read('start.txt'), goal: `exercises/${id}.png`, known, folder: name }
})
