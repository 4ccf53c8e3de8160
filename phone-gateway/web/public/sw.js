// Keeps a copy of the app for when the robot is away. The network comes first, so that a new version is
// seen at once; files under /assets/ are named after what is in them and never change.
const kCache = "nao-remote-2";

self.addEventListener("install", (event) => event.waitUntil(keepShell().then(() => self.skipWaiting())));

/** The page and what it names, without the image that a home screen keeps itself; the browser has most of it already. */
async function keepShell() {
  const page = await fetch("/");
  const cache = await caches.open(kCache);
  await cache.put("/", page.clone());
  const named = [...(await page.text()).matchAll(/(?:src|href)="([^"]+)"/g)].map(([, path]) => path);
  await cache.addAll(named.filter((path) => !path.endsWith(".png")));
}

/** What the page has fetched beside that before this worker was there, as the texts of its language. */
self.addEventListener("message", (event) => event.waitUntil(caches.open(kCache).then((cache) => cache.addAll(event.data))));

self.addEventListener("activate", (event) => {
  event.waitUntil(caches.keys().then((names) => Promise.all(
      names.filter((name) => name !== kCache).map((name) => caches.delete(name))))
      .then(() => self.clients.claim()));
});

self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== location.origin || url.search) return;
  event.respondWith(url.pathname.startsWith("/assets/") ? cacheFirst(event.request)
                                                        : networkFirst(event.request));
});

async function cacheFirst(request) {
  return (await caches.match(request)) ?? fetchAndKeep(request);
}

async function networkFirst(request) {
  try {
    return await fetchAndKeep(request);
  } catch (error) {
    const kept = await caches.match(request, {ignoreSearch: true});
    if (kept) return kept;
    throw error;
  }
}

async function fetchAndKeep(request) {
  const response = await fetch(request);
  if (response.ok) {
    const cache = await caches.open(kCache);
    await cache.put(request, response.clone());
  }
  return response;
}
