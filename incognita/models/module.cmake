incognita_module(models FOLDERS models USES incognita::math)
