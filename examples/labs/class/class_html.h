/*
 * class_html: the results of a class as pages that open from disk, without network or scripts.
 *
 * OUT/index.html is the class's page. OUT/students/FOLDER/index.html is one student's: it names no
 * other student and has no links, so its folder can be handed out.
 */
#ifndef CLASS_HTML_H
#define CLASS_HTML_H

#include "labs/class/class_store.h"

/* `front`: pareto_front_draw has drawn its plot. Each file is written whole or not at all. */
bool class_html_write(const ClassStore *store, bool front, Message *message);

#endif
