import DefaultTheme from 'vitepress/theme'
import LiveFigure from './LiveFigure.vue'
import StagePlayer from './StagePlayer.vue'
import TermIndex from './TermIndex.vue'
import TryCommands from './TryCommands.vue'
import './style.css'

export default {
  extends: DefaultTheme,
  enhanceApp({ app }) {
    app.component('LiveFigure', LiveFigure)
    app.component('StagePlayer', StagePlayer)
    app.component('TermIndex', TermIndex)
    app.component('TryCommands', TryCommands)
  }
}
