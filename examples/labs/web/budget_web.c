/* Operations are counted by glslang, a process: lab 10's points are those for a right picture. */
#include "labs/check/budget.h"

#include <stdio.h>

bool budget_score(const LabBudget *budget, GLuint program, Canvas *canvas,
                  const SubmissionFiles *files, Verdict *verdict, Message *message)
{
    (void)budget, (void)program, (void)canvas, (void)files, (void)message;
    if (verdict->kind != VERDICT_RIGHT)
        return true;
    verdict->points = 5;
    snprintf(verdict->details, sizeof verdict->details,
             "Operations are not counted in the browser: for up to 5 more points, check natively.");
    return true;
}

bool budget_preprocess(const SubmissionFiles *files, SubmissionFiles *plain, Message *message)
{
    (void)files;
    *plain = (SubmissionFiles){.count = 0};
    return message_set(message, "glslangValidator: not in the browser");
}
