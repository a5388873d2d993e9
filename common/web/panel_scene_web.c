/* A page's controls are the page's own. */
#include "kinds/scene_views.h"

const PanelKind SCENE_PANEL = {0};
