// `npm run build`: the module, the assets, the page.

import { bakeAssets } from './assets.mjs';
import { buildModules } from './module.mjs';
import { buildPage } from './page.mjs';

buildModules();
bakeAssets();
await buildPage();
