// What the site says, in both languages.
const en = {
  loading: 'loading the stage …', failed: (why) => `This stage does not run here: ${why}. The picture above is its golden.`,
  checked: (hash) => `The picture at rest is the golden, bit for bit: hash ${hash}.`,
  wrong: (hash, golden) => `The picture at rest has the hash ${hash}, and should have ${golden}. Please report it.`,
  picture: (name) => `${name}: drag or use the arrow keys to turn, the wheel or + and − to zoom, 0 to go back`,
  turnLeft: 'turn left', turnRight: 'turn right', up: 'look from above', down: 'look from below', nearer: 'nearer', farther: 'farther',
  reset: 'reset', compare: (id) => `compare with ${id}`, inside: 'look inside', color: 'the picture',
  pixel: 'ask a pixel', pixelHint: 'Click a pixel, or move the cross by the arrow keys and press Enter.', life: (x, y) => `The life of pixel ${x},${y}`,
  telling: 'asking the pixel …', close: 'close', properties: 'properties', share: 'link to this picture', shared: 'The address of this page now leads to this picture.',
  frame: (ms, w, h) => `${w} × ${h} in ${ms} ms`, tried: 'shown above', edit: 'edit this shader',
  editorLabel: (file) => `Editor of ${file}`, compile: 'compile (Ctrl+Enter)', compiling: 'compiling …', restore: 'as it was', compiled: (ms) => `compiled in ${(ms / 1000).toFixed(1)} s`,
  errors: (n) => n === 1 ? 'one error' : `${n} errors`, loadingCompiler: (mb, of) => `loading the compiler: ${mb} of ${of} MB, once`,
  exercise: 'exercise', noExercise: 'the stage itself', verdicts: {},
  editorHint: 'This is the stage’s own file. It is compiled here, in your browser, by clang; nothing is sent anywhere.',
  edited: (hash, isGolden) => isGolden ? `Your shader gives the golden, bit for bit: hash ${hash}.` : `Your shader’s picture at rest has the hash ${hash}.`,
  doctorHint: 'Choose a map, or drop one here. It is examined in your browser, and sent nowhere.', examining: 'examining …', curedMap: 'the cured map',
  doctorFiles: { map: 'the map', heights: 'the heights that it was made of, if you have them', mesh: 'the mesh that it is for, if you have it' },
  endless: 'The shader did not end within 20 s and was stopped. Look for a loop that does not end.'
}
const zh = {
  loading: '正在载入……', failed: (why) => `此步骤无法在这里运行：${why}。上面是它的基准图。`,
  checked: (hash) => `静止时的画面与基准图逐位相同：哈希 ${hash}。`,
  wrong: (hash, golden) => `静止时画面的哈希是 ${hash}，应为 ${golden}。请报告此问题。`,
  picture: (name) => `${name}：拖动或用方向键旋转，滚轮或 + 和 − 缩放，0 复位`,
  turnLeft: '向左转', turnRight: '向右转', up: '从上方看', down: '从下方看', nearer: '靠近', farther: '远离',
  reset: '复位', compare: (id) => `与 ${id} 对比`, inside: '查看内部', color: '画面',
  pixel: '询问像素', pixelHint: '点击一个像素，或用方向键移动十字并按回车。', life: (x, y) => `像素 ${x},${y} 的一生`,
  telling: '正在询问像素……', close: '关闭', properties: '属性', share: '此画面的链接', shared: '本页地址现在指向此画面。',
  frame: (ms, w, h) => `${w} × ${h}，${ms} 毫秒`, tried: '已在上方显示', edit: '编辑此着色器',
  editorLabel: (file) => `${file} 的编辑器`, compile: '编译（Ctrl+Enter）', compiling: '正在编译……', restore: '恢复原样', compiled: (ms) => `编译用时 ${(ms / 1000).toFixed(1)} 秒`,
  errors: (n) => `${n} 个错误`, loadingCompiler: (mb, of) => `正在载入编译器：${mb} / ${of} MB，只需一次`,
  exercise: '练习', noExercise: '步骤本身', verdicts: { solved: '做对了，逐位相同。', start: '这是给出的文件：请填上空缺。' },
  editorHint: '这是此步骤自己的源文件。它由 clang 在你的浏览器里编译，不会发送到任何地方。',
  edited: (hash, isGolden) => isGolden ? `你的着色器与基准图逐位相同：哈希 ${hash}。` : `你的着色器静止时画面的哈希是 ${hash}。`,
  doctorHint: '选择一张贴图，或把它拖到这里。它在你的浏览器里检查，不会发送到任何地方。', examining: '正在检查……', curedMap: '治好的贴图',
  doctorFiles: { map: '贴图', heights: '它由之做成的高度图（如果有）', mesh: '它所属的网格（如果有）' },
  endless: '着色器在 20 秒内没有结束，已被停止。请检查是否有不会结束的循环。'
}
export const wordsOf = (lang) => lang.startsWith('zh') ? zh : en
