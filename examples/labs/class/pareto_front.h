/*
 * pareto_front: lab 10's submissions by cost and error, and the efficient ones: those that no other
 * beats in both.
 */
#ifndef PARETO_FRONT_H
#define PARETO_FRONT_H

#include "labs/class/class_store.h"

/* Whether no other result has at most its error and cost, and less of one. False: the cost is
 * unknown. */
bool pareto_front_has(const ClassStore *store, const ClassResult *result);

/* Plots them to front.svg and front.png in the store's folder. *drawn: there was anything to plot.
 */
bool pareto_front_draw(const ClassStore *store, bool *drawn, Message *message);

#endif
