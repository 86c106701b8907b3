/* Keeps libraries that a program closes, so that what they never free can be told to be theirs: a leak from
   one that is gone has no name, and OpenGL's drivers are closed before the leaks are looked for. */
int dlclose(void* library) {
    (void)library;
    return 0;
}
