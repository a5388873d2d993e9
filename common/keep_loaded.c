/*
 * keep_loaded: a dlclose that unloads nothing, for builds with AddressSanitizer alone. Drivers are
 * unloaded before the leak check, which then reports what their globals point to as leaks of an
 * unnamed library.
 */
int dlclose(void *handle);

__attribute__((visibility("default"))) int dlclose(void *handle)
{
    (void)handle;
    return 0;
}
