// Between a page's text and its player: the text asks it to show a command, and hears when it is shown.
const players = new Set(), texts = new Set()

export function onShow(listener) {
  players.add(listener)
  return () => players.delete(listener)
}
export function onShown(listener) {
  texts.add(listener)
  return () => texts.delete(listener)
}
export const show = (command) => players.forEach((listener) => listener(command))
export const reportShown = (line) => texts.forEach((listener) => listener(line))
