import DefaultTheme from 'vitepress/theme'
import { nextTick, onMounted, watch } from 'vue'
import { useRoute } from 'vitepress'
import LiveFigure from './LiveFigure.vue'
import MapDoctor from './MapDoctor.vue'
import StagePlayer from './StagePlayer.vue'
import TermIndex from './TermIndex.vue'
import TryCommands from './TryCommands.vue'
import './style.css'

export default {
  extends: DefaultTheme,
  setup() {
    // A group of the sidebar is a button, and the arrow in it says so once more: to screen readers it is a drawing.
    const mend = () => nextTick(() => document.querySelectorAll('.VPSidebarItem .item[role=button] .caret').forEach((caret) => {
      for (const name of ['role', 'tabindex', 'aria-label']) caret.removeAttribute(name)
      caret.setAttribute('aria-hidden', 'true')
    }))
    const route = useRoute()
    onMounted(mend)
    watch(() => route.path, mend)
  },
  enhanceApp({ app }) {
    app.component('LiveFigure', LiveFigure)
    app.component('MapDoctor', MapDoctor)
    app.component('StagePlayer', StagePlayer)
    app.component('TermIndex', TermIndex)
    app.component('TryCommands', TryCommands)
  }
}
