/*
 * keep_loaded: only in builds with AddressSanitizer. Drivers are unloaded before the process ends;
 * what their globals still point to then looks like a leak, from a library that has no name any
 * more. This dlclose stands before the C library's and unloads nothing.
 */
int dlclose(void *handle);

__attribute__((visibility("default"))) int dlclose(void *handle)
{
    (void)handle;
    return 0;
}
