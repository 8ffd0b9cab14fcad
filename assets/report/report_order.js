// The page in the order of what the study is about: what its main result is of comes first.

{
  const measure = data.headline.measure, main = document.querySelector('main'), nav = document.querySelector('nav > div');
  if (measure === 'areas') {
    // Answers stand behind what is told of gaze, and the shares of areas before the maps.
    main.insertBefore(by_id('figure4'), by_id('answers'));
    main.insertBefore(by_id('surface_areas'), by_id('answers'));
    for (const id of ['answers', 'points', 'explorations', 'answer_gaze']) main.insertBefore(by_id(id), by_id('trials'));
  }
  if (measure === 'points') main.insertBefore(by_id('points'), by_id('answers'));
  const links = new Map([...nav.querySelectorAll('a')].map(link => [link.getAttribute('href').slice(1), link]));
  nav.replaceChildren(...[...main.querySelectorAll('section')].filter(section => links.has(section.id)).flatMap(section => [links.get(section.id), ' ']));
}
