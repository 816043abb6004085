// What the figures share: their words in both languages, numbers, and places.
const all = {
  en: {
    tip: (name) => `tip of ${name}`, length: 'length', angle: 'angle', dot: 'dot product', cosine: 'cosine of the angle', shadow: 'shadow of b on a',
    light: 'light', normal: 'normal', point: 'point on the curve', slope: 'slope', brightness: 'brightness', columns: 'columns', area: 'the square’s area becomes',
    weights: 'weights', pixel: 'pixel', red: 'red', green: 'green', blue: 'blue', stored: 'stored', light_: 'light', resolution: 'pixels per side',
    object: 'object', world: 'world', view: 'view', clip: 'on the screen', turn: 'turn the object', move: 'move the object', camera: 'move the camera',
    unit: 'of length 1', color: 'colour', outside: 'outside: one weight is negative', inside: 'inside'
  },
  zh: {
    tip: (name) => `${name} 的端点`, length: '长度', angle: '夹角', dot: '点积', cosine: '夹角的余弦', shadow: 'b 在 a 上的投影',
    light: '光', normal: '法线', point: '曲线上的点', slope: '斜率', brightness: '亮度', columns: '列', area: '正方形的面积变为',
    weights: '权重', pixel: '像素', red: '红', green: '绿', blue: '蓝', stored: '存储值', light_: '光量', resolution: '每边像素数',
    object: '物体', world: '世界', view: '观察', clip: '屏幕上', turn: '旋转物体', move: '移动物体', camera: '移动相机',
    unit: '长度为 1', color: '颜色', outside: '在外面：有一个权重为负', inside: '在里面'
  }
}
export const figureWords = (lang) => lang.startsWith('zh') ? all.zh : all.en
export const number = (value) => (Math.abs(value) < 0.005 ? 0 : value).toFixed(2)

// Where a figure's coordinates are on its drawing: y goes up.
export const at = (place, x, y) => ({ x: place.x + x * place.scale, y: place.y - y * place.scale })
