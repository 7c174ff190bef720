// Preloaded into what the address sanitizer watches: libraries stay when they are closed. Mesa's
// drivers are gone before the leak sanitizer looks, and then what they left behind has no name that
// tools/lsan.supp could match.
extern "C" int dlclose(void*) { return 0; }
