// Words that the search finds, and a page that is among what it finds, by language.
export const searches = {
  '': [['tangent space', 'bumpiness/'], ['whiteout', 'whiteout'], ['DXT5nm', 'dxt5nm'], ['shadow acne', 'shadow_acne'], ['barycentric', 'basics/']],
  'zh/': [
    ['法线', 'bumpiness/'], ['法线贴图', 'normal_map'], ['高度图', 'heights'], ['切线空间', 'tangent'], ['副法线', 'binormal'],
    ['中心差分', 'central_difference'], ['偏导数', 'along_v'], ['叉积', 'both_dimensions'], ['点积', 'dot_product'], ['反照率', 'albedo'],
    ['细节纹理', 'detail'], ['归一化', 'normal'], ['手性', 'mirrored'], ['镜面反射', 'light'], ['电介质', 'first_light'], ['金属度', 'zh/'],
    ['阴影痤疮', 'shadow_acne'], ['阴影贴图', 'glossary'], ['混合权重', 'blend_weights'], ['视差', 'parallax'], ['立方体贴图', 'beyond/'], ['重心权重', 'basics/'],
    ['掠射角', 'zh/'], ['点光源', 'zh/']
  ]
}
