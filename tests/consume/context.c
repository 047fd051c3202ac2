/* Asks the component gl for a dp_gl without saying where OpenGL is, which it refuses; fails when it does not. Where the
 * component is absent, DRYPOINT_HAS_GL is not defined, and nothing is asked. */
#ifdef DRYPOINT_HAS_GL
#include <drypoint/gl.h>

#include <stdio.h>

int main(void) {
    dp_gl *gl = NULL;
    dp_diag diag;
    const dp_result result = dp_gl_create(NULL, &gl, &diag);
    printf("%s: %s\n", dp_result_name(result), diag.message);
    return result != DP_ERR_ARGUMENT || gl;
}
#else
int main(void) { return 0; }
#endif
