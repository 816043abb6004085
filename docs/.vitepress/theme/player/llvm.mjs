// Running clang and its linker as WebAssembly (@yowasp/clang): in a page's worker, and where its files are made.

// {"relief/engine/relief.h": text} as folders in folders of bytes.
export function treeOf(files) {
  const tree = {}, encoder = new TextEncoder()
  for (const [name, text] of Object.entries(files)) {
    const parts = name.split('/')
    let folder = tree
    for (const part of parts.slice(0, -1)) folder = folder[part] ??= {}
    folder[parts.at(-1)] = encoder.encode(text)
  }
  return tree
}

// What a program said when it failed.
export class Refused extends Error {}

// The files that it wrote.
export async function run(commands, program, words, files) {
  let said = ''
  const listen = (bytes) => { if (bytes) said += new TextDecoder().decode(bytes) }
  try {
    return await commands[program](words, files, { stdout: listen, stderr: listen, fetchProgress: () => {} })
  } catch (error) {
    throw new Refused(said === '' ? error.message : said)
  }
}
