/* A page's controls are the page's own. */
#include "kinds/panel_scene.h"

const PanelKind SCENE_PANEL = {0};
