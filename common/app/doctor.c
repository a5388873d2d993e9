/* --doctor: each package and each backend is tried, and says what it found. */
#include "app/doctor.h"

#include "app/options.h"
#include "base/cache.h"
#include "base/plugin.h"
#include "images/animation.h"
#include "images/image_file.h"
#include "images/image_options.h"
#include "window/backends.h"
#include "window/panel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool print_findings(bool (*probe)(Message *findings), Message *findings)
{
    *findings = (Message){.text = ""};
    const bool works = probe(findings);
    fputs(findings->text, stdout);
    return works;
}

/* What was measured of a backend's driver. GALLIUM_OVERRIDE_CPU_CAPS changes what llvmpipe computes
 * with. */
typedef struct Kept {
    char renderer[128], version[128], line[256];
} Kept;

static CacheKey kept_key(const char *backend)
{
    const char *caps = getenv("GALLIUM_OVERRIDE_CPU_CAPS");
    CacheKey key = {{0, 0}};
    cache_key_add(&key, backend, strlen(backend) + 1);
    if (caps)
        cache_key_add(&key, caps, strlen(caps));
    return key;
}

void doctor_keep(const Canvas *canvas, const char *line)
{
    const CacheKey key = kept_key(canvas->backend->name);
    Kept kept;
    memset(&kept, 0, sizeof kept);
    snprintf(kept.renderer, sizeof kept.renderer, "%s", canvas->renderer);
    snprintf(kept.version, sizeof kept.version, "%s", canvas->version);
    snprintf(kept.line, sizeof kept.line, "%s", line);
    cache_write("precision", &key, &kept, sizeof kept);
}

static bool png_probe(Message *findings)
{
    return package_tell(findings, "libpng", image_png_version(), "PNG files", NULL);
}

static bool model_probe(Message *findings)
{
    static Plugin models = {PLUGIN_MODELS};
    return plugin_probe(&models, findings);
}

static bool drawing_probe(Message *findings)
{
    static Plugin drawings = {PLUGIN_DRAWINGS};
    return plugin_probe(&drawings, findings);
}

int doctor_run(void)
{
    static bool (*const packages[])(Message * findings) = {
        png_probe, image_probe, animation_probe, model_probe, drawing_probe, panel_probe};
    Message findings;
    cache_prepare_driver();
    printf("packages:\n");
    for (int i = 0; BACKENDS[i]; i++)
        print_findings(canvas_backend_load(BACKENDS[i])->package, &findings);
    for (size_t i = 0; i < sizeof packages / sizeof packages[0]; i++)
        print_findings(packages[i], &findings);
    const CanvasBackend *usual = backend_default(NULL), *works = NULL;
    for (int i = 0; BACKENDS[i]; i++) {
        printf("%s: %s\n", BACKENDS[i]->name, BACKENDS[i]->summary);
        if (!print_findings(canvas_backend_load(BACKENDS[i])->probe, &findings))
            continue;
        const CacheKey key = kept_key(BACKENDS[i]->name);
        size_t size = 0;
        Kept *kept = cache_read("precision", &key, &size);
        if (kept && size == sizeof *kept && memchr(kept->line, 0, sizeof kept->line) &&
            memchr(kept->renderer, 0, sizeof kept->renderer) &&
            strstr(findings.text, kept->renderer) &&
            memchr(kept->version, 0, sizeof kept->version) && strstr(findings.text, kept->version))
            printf("  %-16s %s\n", "precision", kept->line);
        else
            printf("  %-16s unknown: run precision once\n", "precision");
        free(kept);
        if (!works || BACKENDS[i] == usual)
            works = BACKENDS[i];
    }
    if (works && works == usual)
        printf("This machine can draw.\n");
    else if (works)
        printf("This machine can draw with --backend %s.\n", works->name);
    else
        printf("This machine cannot draw yet.\n");
    return works ? 0 : EXIT_FAILED;
}
