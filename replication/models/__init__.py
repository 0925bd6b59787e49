"""The models: one module each, every function of plain floats, for one case.

`arrays` compiles the same functions for many cases at once and checks what they are given.
"""
