/* Two pipes: orders go one way, one line each, and an answer comes back for every one. */
#include "peer.h"

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static void become(const int orders[2], const int answers[2], const char *program,
                   const char *model) {
    dup2(orders[0], STDIN_FILENO);
    dup2(answers[1], STDOUT_FILENO);
    for (int k = 0; k < 2; k++) close(orders[k]), close(answers[k]);
    execl(program, program, model, "--serve", (char *)NULL);
    perror(program);
    _exit(127);
}

void peer_start(peer *p, const char *program, const char *model) {
    *p = (peer){.child = -1};
    int orders[2], answers[2];
    if (!program || pipe(orders)) return;
    if (pipe(answers)) {
        close(orders[0]);
        close(orders[1]);
        return;
    }
    p->child = fork();
    if (!p->child) become(orders, answers, program, model);
    close(orders[0]);
    close(answers[1]);
    p->orders = fdopen(orders[1], "w");
    p->answers = fdopen(answers[0], "r");
    if (p->child < 0 || !p->orders || !p->answers) peer_stop(p);
}

bool peer_draw(peer *p, unsigned width, unsigned height, unsigned samples, bool lines,
               frame_time *time) {
    char answer[100];
    if (!p->orders) return false;
    fprintf(p->orders, "%u %u %u %d\n", width, height, samples, lines);
    fflush(p->orders);
    const bool good = fgets(answer, sizeof answer, p->answers) &&
                      sscanf(answer, "%lf %lf", &time->ms, &time->cpu_ms) == 2 && time->ms >= 0;
    if (!good) peer_stop(p);
    return good;
}

void peer_stop(peer *p) {
    if (p->orders) fclose(p->orders);
    if (p->answers) fclose(p->answers);
    if (p->child > 0) waitpid(p->child, NULL, 0);
    *p = (peer){.child = -1};
}
