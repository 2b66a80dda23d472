incognita_module(decision FOLDERS decision decision/plan USES incognita::slam)
