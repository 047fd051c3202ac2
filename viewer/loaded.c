/* Opens a model as the program does, to be drawn often. */
#include "loaded.h"

#include "deform.h"
#include "report.h"

#include <math.h>

/* Is it another at another time, by what its options say? */
static bool moves_by_options(const tool_settings *s) {
    const bool stands = s->deform.kind == DP_DEFORM_TWIST && !(fabs(s->deform.speed) > 0);
    return (s->has_deform && !stands) || (s->morph && !s->has_blend);
}

bool loaded_open(tool_settings *s, loaded *m) {
    s->command = COMMAND_VIEW; /* drawn often: never from a pipe */
    s->has_eye = s->has_target = false;
    if (!s->has_time) s->has_time = true, s->time[0] = s->time[1] = 0;
    m->time = s->time[0];
    if (open_model(s, &m->source)) return false;
    if (measure_model(s, m->source, &m->seen)) return false;
    m->seen.aspect = 0;
    m->lasts = dp_source_duration(m->source);
    m->moves = m->lasts > 0 || moves_by_options(s);
    if (!isfinite(m->lasts)) m->lasts = 0;
    const char *const remark = dp_source_remark(m->source);
    if (remark) warn("%s", remark);
    return true;
}

void loaded_free(loaded *model) {
    dp_source_destroy(model->source);
    *model = (loaded){0};
}
