// Words for the search. Chinese is written without spaces: each pair of neighbouring characters is a word, in a page as in
// what the reader types. It is sent to the browser as text, so it must stand alone.
export function tokenize(text) {
  const words = []
  for (const [run] of text.toLowerCase().matchAll(/[\p{Script=Han}]+|[\p{L}\p{N}_]+(?:[.-][\p{L}\p{N}]+)*/gu)) {
    if (!/\p{Script=Han}/u.test(run)) {
      for (const [word] of run.matchAll(/[^\p{Script=Han}]+/gu)) words.push(word)
    }
    for (const [han] of run.matchAll(/\p{Script=Han}+/gu)) {
      if (han.length === 1) words.push(han)
      for (let i = 0; i + 1 < han.length; ++i) words.push(han.slice(i, i + 2))
    }
  }
  return words
}
