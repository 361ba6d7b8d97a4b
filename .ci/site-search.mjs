// Asks the search of the built site: every term is found, and every question has the right page first.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import vm from "node:vm";

const site = process.argv[2];
const file = (start) => readdirSync(site).find((name) => name.startsWith(start) && name.endsWith(".js"));
const context = vm.createContext({ window: {}, console });
context.window.search = {};
context.self = context.window;
for (const name of [file("elasticlunr"), file("searchindex")]) {
    vm.runInContext(readFileSync(join(site, name), "utf8"), context);
}
const elasticlunr = context.elasticlunr ?? context.window.elasticlunr;
const config = context.window.search;
const index = elasticlunr.Index.load(config.index);
const hits = (query) => index.search(query, config.search_options).map((hit) => config.doc_urls[hit.ref]);

const lines = readFileSync(new URL("site-search.txt", import.meta.url), "utf8").split("\n");
let missed = 0;
for (const line of lines.filter((line) => line && !line.startsWith("#"))) {
    const [query, page] = line.split(" -> ");
    const found = hits(query);
    const good = page ? found[0]?.startsWith(page) : found.length > 0;
    if (!good) {
        missed += 1;
        console.error(`search: "${query}" finds ${found.slice(0, 3).join(", ") || "nothing"}${page ? `, not ${page} first` : ""}`);
    }
}
console.log(`search: ${lines.filter((line) => line && !line.startsWith("#")).length} queries, ${missed} missed`);
process.exit(missed ? 1 : 0);
