// What the site says, in both languages.
const en = {
  loading: 'loading the stage …', failed: (why) => `This stage does not run here: ${why}. The picture above is its golden.`,
  checked: (hash) => `The picture at rest is the golden, bit for bit: hash ${hash}.`,
  wrong: (hash, golden) => `The picture at rest has the hash ${hash}, and should have ${golden}. Please report it.`,
  picture: (name) => `${name}: drag or use the arrow keys to turn, the wheel or + and − to zoom, 0 to go back`,
  turnLeft: 'turn left', turnRight: 'turn right', up: 'look from above', down: 'look from below', nearer: 'nearer', farther: 'farther',
  reset: 'reset', compare: (id) => `compare with ${id}`, compareHint: (id) => `left of the line: ${id}`, inside: 'look inside', color: 'the picture',
  pixel: 'ask a pixel', pixelHint: 'Click a pixel, or move the cross by the arrow keys and press Enter.', life: (x, y) => `The life of pixel ${x},${y}`,
  telling: 'asking the pixel …', close: 'close', properties: 'properties', share: 'link to this picture', shared: 'The address of this page now leads to this picture.',
  frame: (ms, w, h) => `${w} × ${h} in ${ms} ms`, tryIt: 'show it', tried: 'shown above', source: 'the whole source', behind: 'This translation is behind the English page.'
}
const zh = {
  loading: '正在载入……', failed: (why) => `此步骤无法在这里运行：${why}。上面是它的基准图。`,
  checked: (hash) => `静止时的画面与基准图逐位相同：哈希 ${hash}。`,
  wrong: (hash, golden) => `静止时画面的哈希是 ${hash}，应为 ${golden}。请报告此问题。`,
  picture: (name) => `${name}：拖动或用方向键旋转，滚轮或 + 和 − 缩放，0 复位`,
  turnLeft: '向左转', turnRight: '向右转', up: '从上方看', down: '从下方看', nearer: '靠近', farther: '远离',
  reset: '复位', compare: (id) => `与 ${id} 对比`, compareHint: (id) => `分界线左侧：${id}`, inside: '查看内部', color: '画面',
  pixel: '询问像素', pixelHint: '点击一个像素，或用方向键移动十字并按回车。', life: (x, y) => `像素 ${x},${y} 的一生`,
  telling: '正在询问像素……', close: '关闭', properties: '属性', share: '此画面的链接', shared: '本页地址现在指向此画面。',
  frame: (ms, w, h) => `${w} × ${h}，${ms} 毫秒`, tryIt: '显示', tried: '已在上方显示', source: '完整源代码', behind: '此译文落后于英文页面。'
}
export const wordsOf = (lang) => lang.startsWith('zh') ? zh : en
