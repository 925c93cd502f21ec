; The paper's problem (figures 9 and 10): 20 % in the vehicle and in both distributors, demands of 70 % and 100 %,
; 50 % wanted in both distributors at the end. a1 - f1 - a2 lie on one line.
; Variant with the state-dependent transport cost (distance x level on board).
(define (problem paper)
  (:domain tank-bench-load)
  (:objects
    v1 - vehicle
    f1 - supplier
    a1 a2 - distributor
    c1 c2 - client
    level1 level2 level3 level4 level5 level6 level7 level8 level9 level10 - leveltransf)
  (:init
    (is-at v1 f1)
    (serves a1 c1) (serves a2 c2)
    (= (lev v1) 2) (= (maxlevel v1) 10) (= (critical v1) 2)
    (= (level a1) 2) (= (max-level a1) 10) (= (critical-level a1) 2)
    (= (level a2) 2) (= (max-level a2) 10) (= (critical-level a2) 2)
    (= (demand c1) 7) (= (received c1) 0)
    (= (demand c2) 10) (= (received c2) 0)
    (= (distance f1 a1) 1) (= (distance a1 f1) 1)
    (= (distance f1 a2) 1) (= (distance a2 f1) 1)
    (= (distance a1 a2) 2) (= (distance a2 a1) 2)
    (= (amount level1) 1) (= (amount level2) 2) (= (amount level3) 3) (= (amount level4) 4)
    (= (amount level5) 5) (= (amount level6) 6) (= (amount level7) 7) (= (amount level8) 8)
    (= (amount level9) 9) (= (amount level10) 10)
    (= (transport-cost) 0)
    (= (postponed) 0))
  (:goal (and
    (is-at v1 f1)
    (= (level a1) 5)
    (= (level a2) 5)
    (>= (received c1) (demand c1))
    (>= (received c2) (demand c2))))
  (:metric minimize (+ (transport-cost) (* 50 (postponed)))))
