#include "pipe/context.h"
void dp_recording_free(dp_context *context) { (void)context; }
