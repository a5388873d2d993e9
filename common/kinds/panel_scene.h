/*
 * panel_scene: what a window's panel shows of a program with scenes.
 */
#ifndef PANEL_SCENE_H
#define PANEL_SCENE_H

#include "app/panel_kind.h"

extern const PanelKind SCENE_PANEL;

#endif
