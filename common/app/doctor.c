#include "app/doctor.h"

#include "app/options.h"
#include "base/cache.h"
#include "images/animation.h"
#include "images/drawing.h"
#include "images/image_file.h"
#include "shapes/model.h"
#include "window/backends.h"
#include "window/panel.h"

#include <stdio.h>

static bool print_findings(bool (*probe)(Message *findings))
{
    Message findings = {0};
    const bool works = probe(&findings);
    fputs(findings.text, stdout);
    return works;
}

int doctor_run(void)
{
    static const struct {
        const char *title;
        bool (*probe)(Message *findings);
    } modules[] = {{"pictures", image_probe},
                   {"animations", animation_probe},
                   {"models", model_probe},
                   {"diagrams", drawing_probe},
                   {"the panel of windows", panel_probe}};
    cache_prepare_driver();
    const CanvasBackend *usual = backend_default(NULL), *works = NULL;
    for (int i = 0; BACKENDS[i]; i++) {
        printf("%s: %s\n", BACKENDS[i]->name, BACKENDS[i]->summary);
        if (print_findings(BACKENDS[i]->probe) && (!works || BACKENDS[i] == usual))
            works = BACKENDS[i];
    }
    for (size_t i = 0; i < sizeof modules / sizeof modules[0]; i++) {
        printf("%s:\n", modules[i].title);
        print_findings(modules[i].probe);
    }
    if (works && works == usual)
        printf("This machine can draw.\n");
    else if (works)
        printf("This machine can draw with --backend %s.\n", works->name);
    else
        printf("This machine cannot draw yet.\n");
    return works ? 0 : EXIT_FAILED;
}
