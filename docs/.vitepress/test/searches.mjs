// Words that the search finds, and a page that is among what it finds, by language.
export const searches = {
  '': [['tangent space', 'bumpiness/'], ['whiteout', 'whiteout'], ['DXT5nm', 'dxt5nm'], ['shadow acne', 'shadow_acne'], ['barycentric', 'basics/']],
  'zh/': []
}
