// The book as a site: every page of docs/, and those beside it that they lead to. ./relief book runs this.
import fs from 'node:fs'
import path from 'node:path'
import { defineConfig } from 'vitepress'
import { exercises } from './exercises.mjs'
import relief, { base, copyOf, linkedFiles, pageOf } from './markdown.mjs'
import { tokenize } from './search.mjs'
import { chapters, root } from './stages.mjs'

const docs = path.join(root, 'docs')
const build = path.join(root, 'build')

const title = (file) => fs.readFileSync(path.join(root, file), 'utf8').match(/^# (.*)/m)[1]
const startPages = fs.readdirSync(path.join(docs, 'start')).sort()
const topics = ['change_something', 'exercises', 'teaching', 'look_inside', 'life_of_a_pixel', 'your_own_files', 'doctor', 'programs', 'porting', 'library', 'check',
  'performance', 'machines', 'many_machines', 'triplanar_signs', 'glossary', 'terms', 'site']

// A page is in the other language where its file is there.
function sidebar(language) {
  const folder = language === 'zh' ? 'docs/zh/' : 'docs/'
  const address = language === 'zh' ? '/zh/' : '/'
  const item = (name) => fs.existsSync(path.join(root, folder + name + '.md'))
    ? [{ text: title(folder + name + '.md'), link: address + name }] : []
  const words = language === 'zh' ? ['从这里开始', '工具与主题'] : ['Start here', 'Tools and topics']
  return [
    { text: words[0], collapsed: false, items: startPages.flatMap((file) => item('start/' + file.slice(0, -3))) },
    ...chapters.map((chapter) => ({
      text: chapter[language], collapsed: true,
      items: chapter.stages.flatMap((stage) => item(`${stage.folder}/${stage.stem}`))
    })),
    { text: words[1], collapsed: true, items: topics.flatMap(item) }
  ].filter((group) => group.items.length > 0)
}

// Beside the pages: what the players load, and copies of the files that pages link to.
function copyFiles(out) {
  const copy = (from, to) => {
    fs.mkdirSync(path.dirname(path.join(out, to)), { recursive: true })
    fs.copyFileSync(from, path.join(out, to))
  }
  for (const file of fs.readdirSync(path.join(root, 'assets')).filter((f) => f.endsWith('.png'))) {
    copy(path.join(root, 'assets', file), 'player/assets/' + file)
  }
  for (const chapter of chapters) {
    for (const stage of chapter.stages) linkedFiles.add(`samples/${stage.folder}/${stage.stem}.cpp`)
  }
  for (const file of linkedFiles) {
    copy(path.join(root, file), copyOf(file))
  }
  for (const file of fs.readdirSync(path.join(build, 'web/book'))) copy(path.join(build, 'web/book', file), 'player/' + file)
  for (const file of fs.readdirSync(path.join(build, 'web/compiler'))) copy(path.join(build, 'web/compiler', file), 'player/compiler/' + file)
  for (const { folder, files } of exercises) {
    for (const file of files) copy(path.join(root, 'samples/exercises', folder, file), `player/exercises/${folder}/${file}`)
  }
  fs.writeFileSync(path.join(out, 'player/exercises.json'), JSON.stringify(exercises))
  copy(path.join(docs, '.vitepress/theme/icon.svg'), 'icon.svg')
  for (const file of ['worker.js', 'compiler.js', 'judge.js', 'llvm.mjs']) copy(path.join(docs, '.vitepress/theme/player', file), 'player/' + file)
}

// Pages find the libraries where this file does.
const libraries = {
  name: 'relief-libraries',
  enforce: 'pre',
  resolveId(name, importer) {
    const isElsewhere = importer?.startsWith(root) && !importer.includes('/.vitepress/')
    return isElsewhere && /^vue(\/|$)/.test(name) ? this.resolve(name, path.join(docs, '.vitepress/config.mjs')) : null
  }
}

export default defineConfig({
  srcDir: root,
  srcExclude: ['build/**', 'gallery/**', 'tests/**', 'samples/**', '**/node_modules/**', 'exercises/**'],
  outDir: process.env.RELIEF_BOOK ?? path.join(build, 'book'),
  cacheDir: path.join(build, 'book_cache'),
  base,
  rewrites: (file) => pageOf(file),
  title: 'Relief',
  head: [['link', { rel: 'icon', href: base + 'icon.svg', type: 'image/svg+xml' }]],
  cleanUrls: false,
  lastUpdated: false,
  locales: {
    root: {
      label: 'English', lang: 'en', description: 'How bump and normal mapping work, stage by stage, in a rasterizer that runs in the page'
    },
    zh: {
      label: '简体中文', lang: 'zh-Hans', link: '/zh/', description: '凹凸贴图与法线贴图的原理：一步一步，在网页里运行的光栅器',
      themeConfig: {
        sidebar: sidebar('zh'),
        outline: { level: [2, 3], label: '本页内容' },
        docFooter: { prev: '上一页', next: '下一页' },
        darkModeSwitchLabel: '深色', lightModeSwitchTitle: '切换到浅色', darkModeSwitchTitle: '切换到深色',
        sidebarMenuLabel: '目录', returnToTopLabel: '回到顶部', langMenuLabel: '语言', skipToContentLabel: '跳到正文'
      }
    }
  },
  themeConfig: {
    sidebar: sidebar('en'),
    outline: { level: [2, 3] },
    search: {
      provider: 'local',
      options: {
        miniSearch: { options: { tokenize }, searchOptions: { tokenize, combineWith: 'AND', prefix: true, fuzzy: 0.1 } },
        locales: {
          zh: {
            translations: {
              button: { buttonText: '搜索', buttonAriaLabel: '搜索' },
              modal: {
                displayDetails: '显示详情', resetButtonTitle: '清除', backButtonTitle: '关闭', noResultsText: '没有找到',
                footer: { selectText: '打开', navigateText: '选择', closeText: '关闭' }
              }
            }
          }
        }
      }
    }
  },
  markdown: {
    math: true, theme: { light: 'github-light-high-contrast', dark: 'github-dark-high-contrast' },
    config: (md) => md.use(relief), languages: [{ name: 'trace', scopeName: 'text.trace', patterns: [] }]
  },
  vite: { plugins: [libraries], build: { chunkSizeWarningLimit: 2000 } },
  buildEnd: ({ outDir }) => copyFiles(outDir)
})
