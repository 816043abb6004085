// The exercises for the book's pages, from samples/exercises: each one's file as a learner gets it. [{id, title, stage, text, folder,
// files}], in order. What is known of their pictures is read by the grader's own code (theme/player/judge.js) from those
// files.
import fs from 'node:fs'
import path from 'node:path'
import { root } from './stages.mjs'

const all = path.join(root, 'samples/exercises')
const files = ['exercise.md', 'answer/answer.cpp', 'catalogue.txt', 'catalogue.png', 'goal.png']

export const exercises = fs.readdirSync(all).filter((name) => /^\d\.\d\d[a-z]_/.test(name)).sort().map((folder) => {
  const page = fs.readFileSync(path.join(all, folder, 'exercise.md'), 'utf8')
  const [, id, title] = page.match(/^# (\S+) (.*)/)
  const [, stage] = page.match(/^Stage (\S+) · \w+/m)
  return { id, title, stage, text: fs.readFileSync(path.join(all, folder, 'start.txt'), 'utf8'), folder, files }
})
