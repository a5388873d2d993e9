/*
 * class_front: lab 10's submissions by what they cost and how wrong they are, and the efficient
 * ones among them: those that no other beats in both.
 */
#ifndef CLASS_FRONT_H
#define CLASS_FRONT_H

#include "class_store.h"

/* Whether no other result of the store is at most as wrong and at most as expensive, and better in
 * one of both. False where the cost is not known. */
bool class_front_has(const ClassStore *store, const ClassResult *result);

/* Draws them into front.svg and front.png in the store's folder. *drawn: there was something to
 * draw. */
bool class_front_draw(const ClassStore *store, bool *drawn, Message *message);

#endif
